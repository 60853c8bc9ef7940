#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# A daemon and a client, watched by strace: every address that they send or connect to is 127.0.0.1.
# Usage: loopback_sends.sh IDL_NODE. Exit status 77: strace is missing or may not trace here.
set -u
node=$1
domain=44
command -v strace >/dev/null || { echo "no strace"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
strace -o "$folder/probe" true 2>/dev/null || { echo "strace may not trace here"; exit 77; }

mkfifo "$folder/input"
# Held open by this shell: the daemon ends when it closes.
exec 3<>"$folder/input"
trace() { strace -f -qq -s 0 -e trace=sendmsg,sendto,sendmmsg,connect -o "$1" "${@:2}"; }
trace "$folder/daemon" "$node" daemon $domain box <"$folder/input" 3>&- >"$folder/said" &
daemon=$!
for _ in $(seq 100); do grep -q ready "$folder/said" && break; sleep 0.05; done
trace "$folder/client" "$node" client $domain 1 20 3>&-
found=$?
# Long enough for several announcements.
sleep 1
exec 3>&-
kill $daemon 2>/dev/null
wait $daemon 2>/dev/null

[ $found -eq 0 ] || { echo "the client did not find the daemon"; exit 1; }
cat "$folder/daemon" "$folder/client" | grep -o 'sa_family=AF_INET6\?, .*' >"$folder/internet"
total=$(wc -l <"$folder/internet")
foreign=$(grep -vc 'inet_addr("127\.0\.0\.1")' "$folder/internet")
echo "$total sends, $foreign of them to other addresses than 127.0.0.1"
if [ "$foreign" -ne 0 ]; then
  grep -v 'inet_addr("127\.0\.0\.1")' "$folder/internet" | sort | uniq -c | head
  exit 1
fi
[ "$total" -gt 10 ]
