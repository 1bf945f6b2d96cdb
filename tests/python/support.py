"""What the tests of the package share."""

import csv
import os
import pathlib
import random
import subprocess

import tlab.command

ROOT = pathlib.Path(__file__).resolve().parents[2]


def tlab_command(*arguments, cwd=None):
    """Starts the command as a user of a shell does."""
    return subprocess.run([tlab.command.find(), *map(str, arguments)], cwd=cwd, capture_output=True, text=True,
                          check=False)


def read_rows(path):
    """A CSV file as dicts of texts."""
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def random_source():
    """Random numbers from a seed that is printed, and can be given as TLAB_SEED."""
    seed = int(os.environ.get("TLAB_SEED") or random.SystemRandom().randrange(10**9))
    print(f"TLAB_SEED={seed}", flush=True)
    return random.Random(seed)
