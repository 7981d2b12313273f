#!/bin/sh
# gnu_parallel.sh IN.####.exr OUT.####.exr PARTS JOBS: one machine, or several with parallel's --sshlogin.
# The frames are cut into PARTS, JOBS of which run at once and share the cores; each compiles its kernels once.
# What is killed or fails begins again, three times in all, and --skip-existing leaves it what it had finished.
# Without --skip-bad-frames a damaged frame ends its part; the exit code is the number of parts that failed.
set -eu
cores=$(($(nproc) / $4))
seq "$3" | RPF_NUM_THREADS=$((cores > 0 ? cores : 1)) parallel --quote --jobs "$4" --retries 3 \
  "${RPF:-rpf}" "$1" -o "$2" --chunk "{}/$3" --skip-existing
