#!/bin/sh
# run.sh samples|filter SECONDS: fuzzes one target, built before by: cmake --workflow --preset fuzz
# What it learns stays in build/fuzz/corpus, what stops it in build/fuzz/found; found inputs go to tests/fuzz/corpus.
set -eu
subject=$1 seconds=$2
here=$(cd "$(dirname "$0")" && pwd)
build=$here/../../build/fuzz
mkdir -p "$build/corpus/$subject" "$build/found"
export LSAN_OPTIONS="suppressions=$here/leaks.supp:print_suppressions=0"
case $subject in
  samples) set -- "-dict=$here/samples.dict" -max_len=40000 -malloc_limit_mb=256 ;;  # the target's memory limit is 64 MB
  filter) set -- -max_len=4096 ;;
esac
exec "$build/tests/fuzz/fuzz_$subject" "$@" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=4096 -print_final_stats=1 \
  -artifact_prefix="$build/found/$subject-" "$build/corpus/$subject" "$here/corpus/$subject"
