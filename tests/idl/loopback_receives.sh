#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Packets from another network interface do not reach a daemon. Two network namespaces with a cable
# between them: one sends to the ports of a daemon in the other, whose kernel counts what it drops.
# As a control, a daemon without the guard gets the same packets.
# Usage: loopback_receives.sh IDL_NODE. Exit status 77: namespaces cannot be made here.
set -u
node=$1
domain=44
packets=5
for tool in unshare nsenter ip; do
  command -v $tool >/dev/null || { echo "no $tool"; exit 77; }
done
if [ "${STOSS_INSIDE:-}" != 1 ]; then
  unshare -n true 2>/dev/null || { echo "may not make a network namespace"; exit 77; }
  STOSS_INSIDE=1 exec unshare -n "$0" "$node"
fi

folder=$(mktemp -d)
unshare -n sleep 60 &
other=$!
trap 'kill $other 2>/dev/null; rm -rf "$folder"' EXIT
while [ "$(readlink /proc/$other/ns/net)" = "$(readlink /proc/self/ns/net)" ]; do sleep 0.02; done
there() { nsenter -t $other -n "$@"; }
ip link set lo up
ip link add stoss0 type veth peer name stoss1 2>/dev/null || { echo "no veth here"; exit 77; }
ip link set stoss1 netns $other
ip addr add 10.99.0.1/24 dev stoss0
ip link set stoss0 up
there ip addr add 10.99.0.2/24 dev stoss1
there ip link set stoss1 up

# The sum of packets dropped before the program saw them, over all UDP sockets here.
drops() { awk 'NR > 1 { sum += $NF } END { print sum + 0 }' /proc/net/udp; }

# The discovery and data ports of participant index 0.
discovery=$((7400 + 250 * domain + 10))
attack() {
  local i
  for i in $(seq $packets); do
    there bash -c "printf 'RTPS\2\1' >/dev/udp/10.99.0.1/$discovery"
    there bash -c "printf 'RTPS\2\1' >/dev/udp/10.99.0.1/$((discovery + 1))"
  done
  sleep 0.2
}

# Starts a node of the given kind, attacks it, prints how many packets were dropped.
dropped_by() {
  local before
  mkfifo "$folder/$1"
  exec 3<>"$folder/$1"
  "$node" "$1" $domain box <"$folder/$1" 3>&- >"$folder/said_$1" &
  local daemon=$!
  for _ in $(seq 100); do grep -q ready "$folder/said_$1" && break; sleep 0.05; done
  before=$(drops)
  attack
  echo $(($(drops) - before)) >"$folder/drops_$1"
  # The guard must not harm what comes in on loopback.
  "$node" client $domain 1 10 3>&- >&2 || echo "no client" >"$folder/harmed"
  exec 3>&-
  kill $daemon 2>/dev/null
  wait $daemon 2>/dev/null
  cat "$folder/drops_$1"
}

guarded=$(dropped_by daemon)
unguarded=$(dropped_by unguarded)
echo "of $((2 * packets)) packets the guard dropped $guarded; without it $unguarded were dropped"
[ ! -e "$folder/harmed" ] && [ "$guarded" -eq $((2 * packets)) ] && [ "$unguarded" -eq 0 ]
