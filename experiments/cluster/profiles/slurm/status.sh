#!/bin/sh
# Prints the status of a job for Snakemake: success, failed or running. A job that Slurm does not
# know counts as failed.
state=$(scontrol show job -o "$1" 2>/dev/null | sed -n 's/.* JobState=\([A-Z_]*\).*/\1/p')
case "$state" in
  COMPLETED) echo success ;;
  PENDING | CONFIGURING | RUNNING | COMPLETING | SUSPENDED | STAGE_OUT) echo running ;;
  *) echo failed ;;
esac
