"""Shared by the tests of the package."""

import csv
import os
import pathlib
import random
import subprocess

import tlab.command

ROOT = pathlib.Path(__file__).resolve().parents[2]


def tlab_command(*arguments, cwd=None):
    """Starts the command as a shell would."""
    return subprocess.run([tlab.command.find(), *map(str, arguments)], cwd=cwd, capture_output=True, text=True,
                          check=False)


def read_rows(path):
    """A CSV file as dicts of texts."""
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def random_source():
    """Random numbers from a printed seed, which TLAB_SEED can set."""
    seed = int(os.environ.get("TLAB_SEED") or random.SystemRandom().randrange(10**9))
    print(f"TLAB_SEED={seed}", flush=True)
    return random.Random(seed)
