#!/bin/sh
#SBATCH --job-name=rpf --array=1-4 --cpus-per-task=1 --mem=1000 --requeue --open-mode=append
# sbatch slurm_array.sh IN.####.exr OUT.####.exr: a task of the array filters its part of the frames.
# Threads and memory are what Slurm gives the task: rpf reads SLURM_CPUS_PER_TASK and SLURM_MEM_PER_NODE.
# A task that loses its node is queued again (--requeue), and --skip-existing leaves it what it had finished.
# A frame that cannot be filtered makes the task fail with rpf's exit code; the last line of its log names it.
exec "${RPF:-rpf}" "$1" -o "$2" --chunk "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" --skip-existing --skip-bad-frames
