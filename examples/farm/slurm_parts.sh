#!/bin/sh
# slurm_parts.sh IN.samples.exr OUT.exr PARTS: one frame by PARTS tasks of a Slurm array, in a folder that all nodes see.
# The first job finds the facts of the frame, the array filters a part of its rows a task, the last job joins the parts.
# A task that loses its node is queued again (--requeue), and --skip-existing leaves it a part that was finished.
# A part that is missing in the end makes the last job fail with the rows in its log; filter them and join again.
set -eu
rpf=${RPF:-rpf} options="--parsable --cpus-per-task=1 --mem=1000 --requeue --open-mode=append"
facts=$(sbatch $options --job-name=facts --wrap "'$rpf' facts '$1' -o '$2.facts.json'" | cut -d\; -f1)
parts=$(sbatch $options --job-name=parts --array="1-$3" --dependency="afterok:$facts" --wrap \
  "'$rpf' '$1' -o '$2.'\$SLURM_ARRAY_TASK_ID.part.exr --rows \$SLURM_ARRAY_TASK_ID/$3 --facts '$2.facts.json' --skip-existing" | cut -d\; -f1)
join=$(sbatch $options --job-name=join --dependency="afterany:$parts" --wrap "'$rpf' join '$2.'*.part.exr -o '$2'" | cut -d\; -f1)
echo "$facts $parts $join"
