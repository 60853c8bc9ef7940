#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# `deploy/run --for 5` builds, runs a world, shows numbers that move, and leaves no daemon behind.
set -eu
source=$1
build=$2
world=run-test-$$
output=$(mktemp -d)
trap 'rm -rf "$output"' EXIT
export TMPDIR="$output"

fail() {
  echo "$*"
  cat "$output"/*.log "$output/out"
  exit 1
}

begin=$(date +%s)
"$source/deploy/run" --for 5 --build "$build" --world "$world" --domain 100 >"$output/out" 2>&1 ||
  fail "exit status $?"
end=$(date +%s)

grep -q "The world '$world' is running" "$output/out" || fail "it did not say that a world runs"
# The same disks are shown at the beginning and at the end.
[ "$(grep -cE '^ *1 ' "$output/out")" -ge 2 ] || fail "disk 1 was not shown twice"
[ "$(grep -E '^ *1 ' "$output/out" | sort -u | wc -l)" -ge 2 ] || fail "disk 1 has not moved"
[ $((end - begin)) -ge 5 ] || fail "it ended after $((end - begin)) s"
! pgrep -f -- "stossd .*--world $world" || fail "a daemon was left behind"
cat "$output/out"
