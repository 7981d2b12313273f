#!/bin/sh
# deadline.sh IN.%04d.exr OUT.%04d.exr FRAMES: a command-line job of Deadline; nobody ran it here, for want of a repository.
# Deadline writes the first and last frame of a task in the place of <STARTFRAME> and <ENDFRAME>, which --frames takes.
# A task that failed is tried again as the repository says, and --skip-existing leaves it what it had finished.
# Threads are those of the machine; on shared workers set RPF_NUM_THREADS and RPF_MAX_MEMORY_MB in the job's environment.
exec deadlinecommand -SubmitCommandLineJob -name rpf -executable "${RPF:-rpf}" -frames "$3" -chunksize 10 \
  -arguments "<QUOTE>$1<QUOTE> -o <QUOTE>$2<QUOTE> --frames <STARTFRAME>-<ENDFRAME> --skip-existing --skip-bad-frames"
