#!/bin/sh
# run.sh samples|filter|network SECONDS: fuzzes one target, built before by: cmake --workflow --preset fuzz
# What it learns stays in build/fuzz/corpus, what stops it in build/fuzz/found; found inputs go to tests/fuzz/corpus.
set -eu
subject=$1 seconds=$2
here=$(cd "$(dirname "$0")" && pwd)
build=$here/../../build/fuzz
mkdir -p "$build/corpus/$subject" "$build/found"
case $subject in
  samples) set -- "-dict=$here/samples.dict" -max_len=40000 -malloc_limit_mb=256 ;;  # the target's memory limit is 64 MB
  network) set -- -dict="$here/network.dict" -max_len=8192 ;;
  filter)
    # The leak checker of clang 15 itself crashes in a process with PoCL's kernels; tests/reliability/soak.py looks for leaks.
    export ASAN_OPTIONS=detect_leaks=0
    set -- -max_len=4096 -detect_leaks=0 ;;
esac
# A minute, so that a machine with more to do does not look like a hang; milliseconds are usual.
exec "$build/tests/fuzz/fuzz_$subject" "$@" -max_total_time="$seconds" -timeout=60 -rss_limit_mb=4096 -print_final_stats=1 \
  -artifact_prefix="$build/found/$subject-" "$build/corpus/$subject" "$here/corpus/$subject"
