"""Changes the program in one place at a time and looks whether the tests notice.

All changes are in one build, each behind a switch. A mutant is killed if a test fails, crashes or takes 10 s
and ten times as long as without it. Only the tests that come by the changed place are run, the shortest first."""
import argparse
import concurrent.futures
import hashlib
import json
import os
import random
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib
from dataclasses import asdict
from pathlib import Path

from clang.cindex import Config

from sites import Site, find_sites

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build" / "mutation"
ROOMS = ["base", "topologies", "renderer", "simulator", "experiments"]
JUDGED = Path(__file__).parent / "judged.toml"
# Tests of the text of sources, of other programs, and of tests like this one.
NOT_RUN = re.compile(r"^(Kills|Fuzz|IncludeGraph|Docs|Consumer)\b|Spin")


def room_of(file):
    """The room and the room inside it."""
    parts = Path(file).parts
    return "/".join(parts[:3 if parts[0] == "experiments" else 2]) if len(parts) > 2 else parts[0]


def read_commands():
    subprocess.run(["cmake", "--preset", "release"], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    commands = {}
    for entry in json.loads((ROOT / "build/release/compile_commands.json").read_text()):
        file = Path(entry["file"])
        words = shlex.split(entry["command"])
        flags = [w if not w.startswith("-I") else "-I" + str((Path(entry["directory"]) / w[2:]).resolve())
                 for w in words if w.startswith(("-I", "-D", "-std"))]
        system = [words[i + 1] for i, w in enumerate(words) if w == "-isystem"]
        commands[str(file.resolve().relative_to(ROOT))] = flags + [x for s in system for x in ("-isystem", s)]
    return commands


def read_sites(file, arguments):
    """The places of a source, kept until it changes: to parse one takes seconds."""
    text = (ROOT / file).read_bytes() + Path(__file__).with_name("sites.py").read_bytes()
    kept = BUILD / "sites" / (hashlib.sha256(file.encode() + text).hexdigest() + ".json")
    if not kept.exists():
        sites = [asdict(site) for site in find_sites(ROOT, file, arguments)]
        kept.parent.mkdir(parents=True, exist_ok=True)
        part = kept.with_suffix(f".{os.getpid()}")
        part.write_text(json.dumps(sites))
        part.rename(kept)
    return [Site(**site) for site in json.loads(kept.read_text())]


def draw_apart(sites, number, draw):
    """Of a source's places so many that do not overlap."""
    drawn = []
    for site in draw.sample(sites, len(sites)):
        if len(drawn) < number and all(site.end <= other.start or site.start >= other.end for other in drawn):
            drawn.append(site)
    return drawn


def choose(rooms, number, seed):
    """As many mutants of every room inside a room as of another, and of its sources likewise."""
    commands = read_commands()
    by_room = {}
    for file in sorted(commands):
        if any(file.startswith(room + "/") for room in rooms):
            by_room.setdefault(room_of(file), []).append(file)
    draw = random.Random(seed)
    share = -(-number // len(by_room))
    files = [file for room in sorted(by_room) for file in draw.sample(by_room[room], min(share, len(by_room[room])))]
    with concurrent.futures.ProcessPoolExecutor() as pool:
        sites = dict(zip(files, pool.map(read_sites, files, [commands[file] for file in files])))
    print(f"{sum(map(len, sites.values()))} places in {len(files)} sources of {len(by_room)} rooms; seed {seed}", flush=True)
    drawn = {file: draw_apart(sites[file], share, draw) for file in files}
    chosen, some = [], True
    while some and len(chosen) < number:
        # A round takes one place of each room, from the source that has given fewest.
        some = False
        for room in draw.sample(sorted(by_room), len(by_room)):
            left = [file for file in files if drawn[file] and room_of(file) == room]
            if left and len(chosen) < number:
                file = min(left, key=lambda f: sum(site.file == f for site in chosen))
                chosen.append(drawn[file].pop())
                some = True
    return {i + 1: site for i, site in enumerate(sorted(chosen, key=lambda s: (s.file, s.start)))}


def write_sources(mutants, left_out=()):
    """A copy of the tree, changed; files that have not changed keep their dates."""
    source = BUILD / "source"
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], cwd=ROOT, check=True, text=True,
                            capture_output=True).stdout.split("\n")
    by_file = {}
    for number, site in mutants.items():
        if number not in left_out:
            by_file.setdefault(site.file, []).append((site, number))
    for file in filter(None, listed):
        target, text = source / file, (ROOT / file).read_bytes()
        for site, number in sorted(by_file.get(file, []), key=lambda m: -m[0].start):
            text = text[:site.start] + site.write(number).encode() + text[site.end:]
        target.parent.mkdir(parents=True, exist_ok=True)
        if not target.exists() or target.read_bytes() != text:
            target.write_bytes(text)
            shutil.copymode(ROOT / file, target)
    return source


def build(mutants, targets):
    """Builds all of them, or some targets; returns the numbers of those that do not compile."""
    left_out = set()
    header = Path(__file__).parent / "mutant.hpp"
    while True:
        source = write_sources(mutants, left_out)
        shutil.copy(header, source / "mutant.hpp")
        subprocess.run(["cmake", "-S", source, "-B", BUILD / "tree", "-DCMAKE_BUILD_TYPE=Release",
                        f"-DCMAKE_CXX_FLAGS=-std=c++20 -include {source / 'mutant.hpp'} -w"], check=True, stdout=subprocess.DEVNULL)
        made = subprocess.run(["cmake", "--build", BUILD / "tree", "-j", str(os.cpu_count()), "--target", *targets, "--",
                               "-k"], text=True, capture_output=True)
        if made.returncode == 0:
            return left_out
        # The mutants on the lines with errors, or else all in their files.
        wrong, files = set(), set()
        for file, line in set(re.findall(r"([\w/.-]+\.cpp):(\d+):\d+: error", made.stdout + made.stderr)):
            path = (BUILD / "tree" / file).resolve()
            files.add(str(path.relative_to(source)))
            text = path.read_text().split("\n")[int(line) - 1]
            wrong |= {int(n) for n in re.findall(r"is_mutant\((\d+)\)", text)}
        wrong = (wrong - left_out) or ({n for n, s in mutants.items() if s.file in files} - left_out)
        if not wrong:
            sys.exit(made.stderr[-3000:] or made.stdout[-3000:])
        left_out |= wrong


def list_tests(wanted):
    shown = subprocess.run(["ctest", "--show-only=json-v1"], cwd=BUILD / "tree", check=True, text=True,
                           capture_output=True).stdout
    tests = []
    for test in json.loads(shown)["tests"]:
        properties = {p["name"]: p["value"] for p in test.get("properties", [])}
        if "command" in test and not NOT_RUN.search(test["name"]) and re.search(wanted, test["name"]):
            tests.append((test["name"], test["command"], properties.get("WORKING_DIRECTORY", BUILD / "tree")))
    return tests


def run_test(test, environment, limit_s):
    """Whether it passes."""
    name, command, folder = test
    with tempfile.TemporaryDirectory() as temporary:
        process = subprocess.Popen(command, cwd=folder, env=os.environ | {"TMPDIR": temporary} | environment,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        try:
            return process.wait(limit_s) == 0
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, 9)
            process.wait()
            return False


def measure(test):
    """Which mutants a test comes by, and its time; none if it fails by itself."""
    with tempfile.NamedTemporaryFile() as file:
        begin = time.monotonic()
        passed = run_test(test, {"TLAB_REACHED": file.name}, 600)
        took = time.monotonic() - begin
        reached = Path(file.name).read_bytes()
    return (took, {i for i, byte in enumerate(reached) if byte} if passed else set(), passed)


def try_mutant(number, tests):
    """The name of the test that kills it, and how many were run."""
    for count, (test, took) in enumerate(tests, 1):
        if not run_test(test, {"TLAB_MUTANT": str(number)}, 10 + 10 * took):
            return test[0], count
    return None, len(tests)


def read_judged():
    if not JUDGED.exists():
        return {}
    return {(j["file"], j["old"], j["new"]): j["judgement"] for j in tomllib.loads(JUDGED.read_text()).get("mutant", [])}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rooms", nargs="+", default=ROOMS, metavar="R", help="folders, e.g. simulator/farm")
    parser.add_argument("--number", type=int, default=300, help="of mutants [300]")
    parser.add_argument("--seed", type=int, default=1, help="of the choice [1]")
    parser.add_argument("--targets", nargs="+", default=["all"], metavar="T", help="test programs to build [all]")
    parser.add_argument("--tests", default="", help="a pattern of names; all unless given")
    parser.add_argument("--list", action="store_true", help="only print the mutants")
    options = parser.parse_args()
    libraries = sorted(Path("/usr/lib/llvm-14/lib").glob("libclang*.so*"))
    if libraries:
        Config.set_library_file(str(libraries[0]))
    mutants = choose(options.rooms, options.number, options.seed)
    if options.list:
        for number, site in mutants.items():
            print(f"{number:4} {site.file}:{site.line} {site.kind}: {site.old!r} -> {site.new!r}")
        return 0
    refused = build(mutants, options.targets)
    tests = list_tests(options.tests)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        measured = list(pool.map(measure, tests))
        failing = [t[0] for t, (_, _, passed) in zip(tests, measured) if not passed]
        print(f"{len(mutants) - len(refused)} mutants, {len(refused)} that do not compile; {len(tests)} tests, "
              f"{len(failing)} of which fail without any: {' '.join(failing)}", flush=True)
        plans = {}
        for number in mutants.keys() - refused:
            reaching = sorted((took, i) for i, (took, reached, _) in enumerate(measured) if number in reached)
            plans[number] = [(tests[i], took) for took, i in reaching]
        outcomes = dict(zip(plans, pool.map(try_mutant, plans, plans.values())))
    report(mutants, outcomes)
    return 0


def report(mutants, outcomes):
    judged, rooms = read_judged(), {}
    for number in sorted(outcomes):
        site, (killer, run) = mutants[number], outcomes[number]
        rooms.setdefault(site.file.split("/")[0] if site.file.count("/") < 2 else room_of(site.file), []).append(
            killer is not None)
        if killer is None:
            judgement = judged.get((site.file, site.old, site.new), "not judged")
            print(f"\n{site.file}:{site.line}: {site.kind}, {run} tests come by: {judgement}\n- {site.old}\n+ {site.new}")
    print(f"\n{'room':32} {'killed':>7} {'of':>5} {'%':>6}")
    for room, killed in sorted(rooms.items()):
        print(f"{room:32} {sum(killed):7} {len(killed):5} {100 * sum(killed) / len(killed):6.1f}")
    everything = [k for killed in rooms.values() for k in killed]
    print(f"{'all':32} {sum(everything):7} {len(everything):5} {100 * sum(everything) / max(1, len(everything)):6.1f}")


if __name__ == "__main__":
    sys.exit(main())
