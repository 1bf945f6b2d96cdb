"""Changes the program in one place at a time and checks whether the tests notice.

All changes are in one build, each behind a switch. A mutant is killed if a test fails twice with it. A test also fails
if it crashes, or if it takes longer than 10 s plus ten times its duration without the mutant. Only tests that execute
the changed place are run: first those in the folder of tests that mirrors the folder of the changed source, then the
others, and each time the shortest test first. They are run until the time limit is reached."""
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
from dataclasses import asdict, dataclass
from pathlib import Path

from clang.cindex import Config

from sites import Site, find_sites

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build" / "mutation"
# Mutated sources are compiled below the build tree, under the same relative paths as in a normal
# build. A compiler cache can then serve all files without a mutant.
SOURCE = BUILD / "source"
TREE = SOURCE / "build" / "release"
RESULTS = BUILD / "results.json"
ROOMS = ["base", "topologies", "renderer", "simulator", "experiments"]
JUDGED = Path(__file__).parent / "judged.toml"
# Tests that are not run: tests of the source text, tests of other programs, and tests that run
# tests.
NOT_RUN = re.compile(r"^(Kills|Fuzz|IncludeGraph|Docs|Consumer|Install)\b|Spin|HaveAtMost100Lines")


def room_of(file):
    """The room of a file (see CMakeLists.txt): its folder, such as simulator/farm, without deeper
    folders."""
    parts = Path(file).parent.parts
    return "/".join(parts[:3 if parts[0] == "experiments" else 2])


def read_commands():
    """The compile command of each source, in a build without unity files."""
    tree = BUILD / "commands"
    subprocess.run(["cmake", "--preset", "release", "-B", tree, "-DCMAKE_UNITY_BUILD=OFF"], cwd=ROOT, check=True,
                   stdout=subprocess.DEVNULL)
    commands = {}
    for entry in json.loads((tree / "compile_commands.json").read_text()):
        file = Path(entry["file"])
        words = shlex.split(entry["command"])
        flags = [w if not w.startswith("-I") else "-I" + str((Path(entry["directory"]) / w[2:]).resolve())
                 for w in words if w.startswith(("-I", "-D", "-std"))]
        system = [words[i + 1] for i, w in enumerate(words) if w == "-isystem"]
        commands[str(file.resolve().relative_to(ROOT))] = flags + [x for s in system for x in ("-isystem", s)]
    return commands


def read_sites(file, arguments):
    """A source's mutation sites, cached until the source changes, because parsing takes seconds."""
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
    """Chooses up to `number` sites of one source. The chosen sites do not overlap."""
    drawn = []
    for site in draw.sample(sites, len(sites)):
        if len(drawn) < number and all(site.end <= other.start or site.start >= other.end for other in drawn):
            drawn.append(site)
    return drawn


def choose(rooms, number, seed):
    """Draws mutants: equally many from each room below the folders `rooms`, and equally many from
    each source of a room."""
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
        # In each round, takes one place from each room: from the room's source with the fewest
        # places so far.
        some = False
        for room in draw.sample(sorted(by_room), len(by_room)):
            left = [file for file in files if drawn[file] and room_of(file) == room]
            if left and len(chosen) < number:
                file = min(left, key=lambda f: sum(site.file == f for site in chosen))
                chosen.append(drawn[file].pop())
                some = True
    return {i + 1: site for i, site in enumerate(sorted(chosen, key=lambda s: (s.file, s.start)))}


def write_sources(mutants, left_out=()):
    """Writes a mutated copy of the tree; unchanged files keep their dates."""
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], cwd=ROOT, check=True, text=True,
                            capture_output=True).stdout.split("\n")
    by_file = {}
    for number, site in mutants.items():
        if number not in left_out:
            by_file.setdefault(site.file, []).append((site, number))
    for file in filter(None, listed):
        target, text = SOURCE / file, (ROOT / file).read_bytes()
        for site, number in sorted(by_file.get(file, []), key=lambda m: -m[0].start):
            text = text[:site.start] + site.write(number).encode() + text[site.end:]
        if file in by_file:
            text = b'#include "mutant.hpp"\n#line 1\n' + text
        target.parent.mkdir(parents=True, exist_ok=True)
        if not target.exists() or target.read_bytes() != text:
            target.write_bytes(text)
            shutil.copymode(ROOT / file, target)
    for folder in {SOURCE / Path(file).parts[0] for file in filter(None, listed) if "/" in file}:
        for path in folder.rglob("*"):
            if path.is_file() and str(path.relative_to(SOURCE)) not in listed:
                path.unlink()  # left by an earlier call
    header = Path(__file__).with_name("mutant.hpp")
    if not (SOURCE / header.name).exists() or (SOURCE / header.name).read_bytes() != header.read_bytes():
        shutil.copy(header, SOURCE)


def build(mutants, targets):
    """Builds all mutants, or some targets; returns the numbers of mutants that do not compile."""
    left_out = set()
    while True:
        write_sources(mutants, left_out)
        subprocess.run(["cmake", "--preset", "release", "-DTLAB_SOONER=ON", "-DCMAKE_UNITY_BUILD_BATCH_SIZE=30"],
                       cwd=SOURCE, check=True, stdout=subprocess.DEVNULL)
        made = subprocess.run(["cmake", "--build", TREE, "-j", str(os.cpu_count()), "--target", *targets, "--", "-k"],
                              text=True, capture_output=True)
        if made.returncode == 0:
            return left_out
        # The mutants on the lines with errors; if there are none, all mutants in the files with
        # errors.
        wrong, files = set(), set()
        for file, line in set(re.findall(r"([\w/.-]+\.cpp):(\d+):\d+: error", made.stdout + made.stderr)):
            path = (TREE / file).resolve()
            files.add(str(path.relative_to(SOURCE)))
            # two lines are inserted before line 1 of each file
            text = "\n".join(path.read_text().split("\n")[int(line) - 1:int(line) + 2])
            wrong |= {int(n) for n in re.findall(r"is_mutant\((\d+)\)", text)}
        wrong = (wrong - left_out) or ({n for n, s in mutants.items() if s.file in files} - left_out)
        if not wrong:
            sys.exit(made.stderr[-3000:] or made.stdout[-3000:])
        left_out |= wrong


@dataclass(frozen=True)
class Test:
    name: str
    command: tuple
    folder: str
    environment: tuple
    source: str  # source file of a gtest suite; "" for other tests
    version: str  # hash of the source


def find_suites():
    """The source of each test suite, with its hash."""
    suites = {}
    for file in sorted((ROOT / "tests").rglob("*_test.cpp")):
        text = file.read_text()
        for suite in set(re.findall(r"^TEST\w*\(\s*(\w+)", text, re.MULTILINE)):
            suites[suite] = (str(file.relative_to(ROOT)), hashlib.sha256(text.encode()).hexdigest())
    return suites


def list_tests(wanted):
    shown = subprocess.run(["ctest", "--show-only=json-v1"], cwd=TREE, check=True, text=True,
                           capture_output=True).stdout
    suites, tests = find_suites(), []
    for test in json.loads(shown)["tests"]:
        properties = {p["name"]: p["value"] for p in test.get("properties", [])}
        # A name that contains the bytes of a parameter is different in each build.
        filters = [word for word in test.get("command", []) if word.startswith("--gtest_filter=")]
        name = filters[0].partition("=")[2] if filters else test["name"]
        if "command" not in test or NOT_RUN.search(name) or not re.search(wanted, name):
            continue
        parts = re.split(r"[./]", name)
        found = next((suites[part] for part in parts if part in suites), ("", ""))
        environment = tuple(tuple(e.split("=", 1)) for e in properties.get("ENVIRONMENT", []))
        tests.append(Test(name, tuple(test["command"]), properties.get("WORKING_DIRECTORY", str(TREE)), environment,
                          *found))
    return tests


def is_own(test, file):
    """Whether the folder of a test mirrors the room of a source."""
    folder = test.source.replace("tests/laboratory", "tests/experiments/laboratory").removeprefix("tests/")
    return bool(folder) and room_of(folder) == room_of(file)


def run_test(test, environment, limit_s):
    """Whether the test passes; None if it exceeds the time."""
    with tempfile.TemporaryDirectory() as temporary:
        process = subprocess.Popen(test.command, cwd=test.folder, start_new_session=True, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL,
                                   env=os.environ | {"TMPDIR": temporary} | dict(test.environment) | environment)
        try:
            return process.wait(limit_s) == 0
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, 9)
            process.wait()
            return None


def measure(test, longest_s):
    """The mutants that a test reaches, its time, and whether it passes within the time limit."""
    with tempfile.NamedTemporaryFile() as file:
        begin = time.monotonic()
        passed = run_test(test, {"TLAB_REACHED": file.name}, longest_s)
        took = time.monotonic() - begin
        reached = Path(file.name).read_bytes()
    numbers = [i for i, byte in enumerate(reached) if byte] if passed else []
    return {"version": test.version, "took_s": took, "passed": passed, "reached": numbers}


def measure_all(tests, known, longest_s, pool):
    """Calls measure() for all tests; for unchanged sources, takes the results of the previous call."""
    wanted = [t for t in tests if known.get(t.name, {}).get("version") != t.version]
    known = {t.name: known[t.name] for t in tests if t not in wanted}
    return known | dict(zip([t.name for t in wanted], pool.map(lambda t: measure(t, longest_s), wanted)))


def try_mutant(number, plan, limit_s):
    """Runs tests until one kills the mutant; returns that test, those that passed, and the number left."""
    begin, passed = time.monotonic(), []
    for test, took in plan:
        if time.monotonic() - begin > limit_s:
            break
        # Repeats a failed test, because tests of interrupts and of time may fail by chance on a
        # busy host.
        if not any(run_test(test, {"TLAB_MUTANT": str(number)}, 10 + 10 * took) for _ in range(2)):
            return {"killer": test.name, "passed": passed, "left": 0}
        passed.append([test.name, test.version])
    return {"killer": None, "passed": passed, "left": len(plan) - len(passed)}


def plan_tests(number, site, tests, measured, done):
    """Returns the tests that reach a mutant, without those already run. Tests in the folder that
    mirrors the source's room come first. Within each group, the shortest test comes first."""
    plan = []
    for test in tests:
        found = measured[test.name]
        if number in found["reached"] and [test.name, test.version] not in done:
            plan.append((not is_own(test, site.file), found["took_s"], test.name, test))
    return [(test, took) for _, took, _, test in sorted(plan, key=lambda p: p[:3])]


def find_again(site):
    """Finds a site again in a source that may have changed since; None if it is gone."""
    if (ROOT / site.file).read_bytes()[site.start:site.end].decode(errors="replace") == site.old:
        return site
    moved = [s for s in read_sites(site.file, read_commands()[site.file])
             if (s.kind, s.old, s.new) == (site.kind, site.old, site.new) and abs(s.line - site.line) <= 10]
    return min(moved, key=lambda s: abs(s.line - site.line), default=None)


def read_judged():
    if not JUDGED.exists():
        return {}
    return {(j["file"], j["line"], j["old"], j["new"]): j["judgement"]
            for j in tomllib.loads(JUDGED.read_text()).get("mutant", [])}


def find_judgement(site, judged):
    """The judgement of a mutant in this line of a source, or None."""
    text = (ROOT / site.file).read_bytes()
    line = text[text.rfind(b"\n", 0, site.start) + 1:].split(b"\n")[0].decode().strip()
    return judged.get((site.file, line, site.old, site.new))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rooms", nargs="+", default=ROOMS, metavar="R", help="folders, e.g. simulator/farm")
    parser.add_argument("--number", type=int, default=300, help="of mutants [300]")
    parser.add_argument("--seed", type=int, default=1, help="of the choice [1]")
    parser.add_argument("--targets", nargs="+", default=["all"], metavar="T", help="test programs to build [all]")
    parser.add_argument("--tests", default="", help="a pattern of names; all unless given")
    parser.add_argument("--seconds", type=float, metavar="T", help="of tests for each mutant [60; with --again no limit]")
    parser.add_argument("--longest", type=float, default=20, metavar="T", help="of a test that is run, in seconds [20]")
    parser.add_argument("--again", action="store_true", help="only those that survived the last call")
    parser.add_argument("--list", action="store_true", help="only print the mutants")
    options = parser.parse_args()
    libraries = sorted(Path("/usr/lib/llvm-14/lib").glob("libclang*.so*"))
    if libraries:
        Config.set_library_file(str(libraries[0]))
    before = json.loads(RESULTS.read_text()) if options.again else {"measured": {}, "outcomes": {}, "refused": []}
    if options.again:
        mutants = {int(n): Site(**site) for n, site in before["mutants"].items()}
        mutants = {n: found for n, site in mutants.items() if (found := find_again(site))}
    else:
        mutants = choose(options.rooms, options.number, options.seed)
    if options.list:
        for number, site in mutants.items():
            print(f"{number:4} {site.file}:{site.line} {site.kind}: {site.old!r} -> {site.new!r}")
        return 0
    refused = set(before["refused"])
    refused |= build({n: site for n, site in mutants.items() if n not in refused}, options.targets)
    tests = list_tests(options.tests)
    limit_s = options.seconds or (float("inf") if options.again else 60)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        measured = measure_all(tests, before["measured"], options.longest, pool)
        failing = [name for name, found in measured.items() if found["passed"] is False]
        long = [name for name, found in measured.items() if found["passed"] is None]
        print(f"{len(mutants) - len(refused)} mutants, {len(refused)} that do not compile; {len(tests)} tests, "
              f"{len(failing)} of which fail without any ({' '.join(failing)}) and {len(long)} take longer than "
              f"{options.longest:g} s ({' '.join(long)})", flush=True)
        outcomes = {int(n): outcome for n, outcome in before["outcomes"].items() if int(n) in mutants}
        numbers = [n for n in mutants if n not in refused and not outcomes.get(n, {}).get("killer")]
        plans = [plan_tests(n, mutants[n], tests, measured, outcomes.get(n, {}).get("passed", [])) for n in numbers]
        for number, outcome in zip(numbers, pool.map(lambda n, plan: try_mutant(n, plan, limit_s), numbers, plans)):
            outcome["passed"] += outcomes.get(number, {}).get("passed", [])
            outcomes[number] = outcome
            if not outcome["killer"]:
                print(show_survivor(number, mutants[number], outcome), flush=True)
    RESULTS.write_text(json.dumps({"mutants": {n: asdict(site) for n, site in mutants.items()}, "outcomes": outcomes,
                                   "refused": sorted(refused), "measured": measured}))
    report(mutants, outcomes)
    return 0


def show_survivor(number, site, outcome):
    judgement = find_judgement(site, read_judged()) or "not judged"
    return (f"\n{number}: {site.file}:{site.line}: {site.kind}, {len(outcome['passed'])} tests came by, "
            f"{outcome['left']} left: {judgement}\n- {site.old}\n+ {site.new}")


def report(mutants, outcomes):
    judged, rooms = read_judged(), {}
    for number in sorted(outcomes):
        site, outcome = mutants[number], outcomes[number]
        judgement = find_judgement(site, judged)
        for room in {site.file.split("/")[0], room_of(site.file)}:
            rooms.setdefault(room, []).append((outcome["killer"] is not None, judgement is not None))
    rooms["all"] = [k for room, killed in rooms.items() if "/" not in room for k in killed]
    print(f"\n{'room':32} {'killed':>7} {'of':>5} {'%':>6} {'judged':>7} {'% of the others':>16}")
    for room, results in sorted(rooms.items()):
        killed, excused = sum(k for k, _ in results), sum(j and not k for k, j in results)
        others = 100 * killed / max(1, len(results) - excused)
        print(f"{room:32} {killed:7} {len(results):5} {100 * killed / len(results):6.1f} {excused:7} {others:16.1f}")


if __name__ == "__main__":
    sys.exit(main())
