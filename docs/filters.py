"""Filters of docs/generate: functions that make Markdown of what commands print.

A filter takes a list of outputs, one for each command, and the arguments that follow its name."""
import csv
import pathlib
import re
import statistics
import sys
import textwrap

ROOT = pathlib.Path(__file__).resolve().parent.parent
MANUAL = ROOT / "docs/manual"
FILTERS = {}


def a_filter(function):
    FILTERS[function.__name__] = function
    return function


# Makes a Markdown table of a list of rows. The first row is the head of the table.
def table(rows):
    cells = [[str(cell).replace("|", "\\|").strip() for cell in row] for row in rows]
    cells.insert(1, ["---"] * len(cells[0]))
    return "\n".join("| " + " | ".join(row) + " |" for row in cells) + "\n"


def code(text):
    return f"`{text}`" if text else ""


def fenced(text, language):
    return f"```{language}\n{text.rstrip()}\n```\n"


# Escapes the characters of a text that Markdown or HTML would interpret. Does not change code between backquotes.
def prose(text):
    parts = re.split(r"(`[^`]*`)", text)
    return "".join(p if p.startswith("`") else re.sub(r"([*_<>\[\]])", r"\\\1", p) for p in parts)


@a_filter
def text(outputs):
    """The printed output, unchanged."""
    return fenced("".join(outputs), "text")


@a_filter
def source(outputs, *functions):
    """A C++ file, or only some of its functions and types. Each one is named by the beginning of its first line."""
    if not functions:
        return fenced(outputs[0], "cpp")
    excerpts = []
    for function in functions:
        start = outputs[0].find("\n" + function) + 1
        if not start:
            sys.exit(f"found no line that begins with {function!r}")
        excerpts.append(outputs[0][start: re.compile(r"^};?$", re.MULTILINE).search(outputs[0], start).end()])
    return fenced("\n\n".join(excerpts), "cpp")


@a_filter
def markdown(outputs):
    """The printed output, which is already Markdown."""
    return outputs[0].rstrip() + "\n"


@a_filter
def usage(outputs):
    """The output of `--help`, with long lines wrapped."""
    help_text = re.sub(r"Usage: \S+", "Usage: tlab", outputs[0])
    help_text = re.sub(r"(--jobs \S+) \[\d+\] +", r"\1 [processors of this host]\n" + 30 * " ", help_text)
    lines = []
    for line in help_text.strip("\n").split("\n"):
        lines += textwrap.wrap(line, 92, subsequent_indent=" " * 30, break_long_words=False,
                               break_on_hyphens=False) or [""]
    return fenced("\n".join(lines), "text")


# Yields indent, name and help of each line "  name    help" in the part of a help text that begins with `head`.
def entries(help_text, head):
    lines = ("\n" + help_text).split("\n" + head, 1)[1].split("\n")[1:]
    for line in lines:
        if not line.strip():
            return
        if match := re.match(r"^( +)(\S+) +(\S.*)$", line):
            yield len(match[1]), match[2], match[3]


@a_filter
def keys(outputs, *sections):
    """Table of the experiment file's keys in the named sections. "other" stands for all names without a dot."""
    rows = [["key", "meaning"]]
    for indent, name, about in entries(outputs[0], "Keys of the experiment file"):
        if name == "model.SECTION.NAME" or indent > 2:
            section = "model"
        else:
            section = name.split(".")[0] if "." in name else "other"
        if section in sections or name in sections:
            rows.append([code(name), prose(about)])
    if len(rows) == 1:
        sys.exit(f"found no key of {', '.join(sections)}")
    return table(rows)


@a_filter
def example(outputs):
    """The example of a help topic."""
    return fenced(re.search(r"^Example:\n\n(.*?)(\n\nKeys:\n|\Z)", outputs[0], re.DOTALL | re.MULTILINE)[1], "toml")


# Reads the help on all keys. Returns, for each program, its description and the rows of its table of parameters.
def parameters_of_programs(help_text):
    found = {}
    for indent, name, about in entries(help_text, "Programs (program.name)"):
        if indent == 2:
            rows = [["parameter", "meaning", "range or choices", "default"]]
            found[name] = about, rows
        else:
            default = re.search(r" \[([^\]]*)\]$", about)
            about = about[: default.start()] if default else about
            what, mark, span = about.rpartition("; ")
            if not re.match(r"whole, |one of |a file$|true or false$|\S+\.\.\S+$", span):
                what, span = about, ""
            rows.append([code(name), prose(what), prose(span), code(default[1]) if default else ""])
    return found


@a_filter
def program(outputs, name):
    """One program. The help on keys gives its parameters; `tlab columns --markdown` gives its results."""
    about, rows = parameters_of_programs(outputs[0])[name]
    columns = re.search(rf"^### {name}\n\n.*?\n\n(.*?)(\n\n|\Z)", outputs[1], re.DOTALL | re.MULTILINE)[1]
    return (f"## `{name}`\n\n{prose(about[0].upper() + about[1:])}.\n\n"
            + (table(rows) + "\n" if len(rows) > 1 else "") + columns.rstrip() + "\n")


@a_filter
def program_pages(outputs):
    """All programs from `tlab list programs`, each with a link to the page that shows it."""
    rows = [["program", "use"]]
    for _, name, about in entries(outputs[0], "programs ("):
        page = next((p.name for p in sorted(MANUAL.glob("program*.md")) if f"| program {name} -->" in p.read_text()), None)
        if not page:
            sys.exit(f"no page of the manual shows the program {name}: add `| program {name}` to one")
        rows.append([f"[`{name}`]({page}#{name})", prose(about)])
    return table(rows)


ENTRY = re.compile(r"^(\S+)\s+(\S+) (\S+)\s+(datasheet|thesis|calibrated|assumed)\s+(?:= (.*?); )?(.*)$")


# The numbers of a model: key, value, unit, provenance, formula, source.
def model_rows(output):
    return [match.groups() for line in output.split("\n") if (match := ENTRY.match(line))]


@a_filter
def model(outputs):
    """A machine model: a table for each of its sections."""
    rows = model_rows(outputs[0])
    parts = []
    for section in dict.fromkeys(row[0].split(".")[0] for row in rows):
        of_section = [["entry", "value", "unit", "provenance", "source"]]
        for key, value, unit, provenance, formula, origin in rows:
            if key.split(".")[0] == section:
                about = (f"`{formula}`; " if formula else "") + prose(origin)
                of_section.append([code(key), value, unit, provenance, about])
        parts.append(f"### {section}\n\n" + table(of_section))
    return "\n".join(parts)


@a_filter
def calibrated(outputs):
    """The calibrated numbers of a model."""
    rows = [[code(key), value, unit, prose(origin)]
            for key, value, unit, provenance, _, origin in model_rows(outputs[0]) if provenance == "calibrated"]
    return table([["entry", "value", "unit", "calibrated on"], *rows])


@a_filter
def differences(outputs):
    """Table of the entries in which models differ, with one column for each model."""
    models = [{row[0]: row[1] for row in model_rows(output)} for output in outputs]
    units = {row[0]: row[2] for row in model_rows(outputs[0])}
    names = [output.split()[1] for output in outputs]
    return table([["entry", "unit", *map(code, names)],
                  *([code(key), units[key], *(m.get(key, "") for m in models)] for key in models[0]
                    if len({m.get(key) for m in models}) > 1)])


@a_filter
def metrics(outputs):
    """Table of the metrics of topologies, with one row for each topology."""
    columns = {}
    for output in outputs:
        pairs = [re.split(r"  +", line.strip(), maxsplit=1) for line in output.strip().split("\n")]
        for number, (name, value) in enumerate(p for p in pairs if p[0] != "root"):
            value = re.sub(r"^(\d+) messages?, (.*)$", r"\1 (\2)", value)
            columns.setdefault(name, []).append(code(value) if number == 0 else value)
    return table([list(columns), *zip(*columns.values())])


@a_filter
def picture(outputs, name, *words):
    """Saves the printed drawing as pictures/NAME, and shows it."""
    (MANUAL / "pictures" / name).write_text(outputs[0])
    return f"![{' '.join(words)}](pictures/{name}){{.net}}\n"


@a_filter
def rooms(outputs):
    """Table of the rooms (C++ modules) in CMakeLists.txt, and of the rooms that each of them may include."""
    rows = [["room", "knows"]]
    for words in re.findall(r"\n *add_room\(([^)]*)\)", outputs[0]):
        name, *rest = words.split()
        knows, section = [], ""
        for word in rest:
            if word in ("WITH", "KNOWS", "LINKS", "USES"):
                section = word
            elif section == "KNOWS":
                knows.append(word)
        rows.append([code(name), ", ".join(map(code, knows))])
    return table(rows)


# Keeps each number and its percent sign on one line.
def whole(numbers):
    return numbers.replace(" %", "&nbsp;%")


CHECK = re.compile(r"^(ok|FAILED)\s+(.*): (\S+) (at .*)$")


@a_filter
def checks(outputs):
    """Table of the checks of `tlab verify`, with one row for each check."""
    rows, experiment = [["experiment", "check", "column", "points", "worst", "allowed"]], ""
    for output in outputs:
        for line in output.split("\n"):
            if found := re.match(r"^(\S+\.toml): ", line):
                experiment = pathlib.Path(found[1]).stem
            elif found := CHECK.match(line):
                verdict, name, column, rest = found.groups()
                points = re.search(r"at (\d+) point", rest)
                worst = re.search(r"worst (?:error )?(\S+(?: %)?)", rest)
                allowed = re.search(r"\(((?:within|at least|at most|between)[^)]*)\)", rest)
                rows.append([code(experiment), prose(name) + ("" if verdict == "ok" else " **FAILED**"), code(column),
                             points[1] if points else "", whole(worst[1].rstrip(",")) if worst else "",
                             whole(allowed[1]) if allowed else ""])
                experiment = ""
    sums = [line for output in outputs for line in output.split("\n") if re.match(r"^\d+ check\(s\) hold", line)]
    return table(rows) + "\n" + "\n".join(sums) + "\n"


@a_filter
def cells(outputs, check, row_key, column_key):
    """Table of one check of `tlab verify --all`: the simulated value for each pair of values of two keys.

    The reference value is in brackets."""
    lines = outputs[0].split("\n")
    start = next(i for i, line in enumerate(lines) if (m := CHECK.match(line)) and m[2] == check)
    head = lines[start + 1].split()
    values, columns = {}, []
    for line in lines[start + 3:]:
        words = line.split()
        if not words:
            break
        at = dict(zip(head, words))
        columns.append(at[column_key])
        mark = "*" if any(word.startswith("calibrated") for word in words) else ""
        values.setdefault(at[row_key], {})[at[column_key]] = \
            f"{mark}{float(at['simulated']):.3f}{mark} ({float(at['reference']):.3f})"
    order = sorted(set(columns), key=float)
    return table([[f"{row_key} \\ {column_key}", *order],
                  *([row, *(values[row].get(c, "") for c in order)] for row in sorted(values, key=float))])


@a_filter
def ratios(outputs):
    """Table of the medians at the end of the benchmarks, compared with other programs."""
    rows = [["", "tlab", "against", "", "ratio"]]
    for line in outputs[0].split("\nmedians, items a second")[1].split("\n")[1:]:
        if found := re.fullmatch(r"(.+?) {2,}([\d.]+)M(?: +(\S.*?) +([\d.]+)M +([\d.]+))?", line):
            what, ours, who, theirs, ratio = found.groups()
            rows.append([what, f"{ours} M/s", who or "", f"{theirs} M/s" if who else "", ratio or ""])
    return table(rows)


@a_filter
def costs(outputs, name):
    """Table and picture (file `name`) of the costs of a transputer and of an event, from the end of the benchmarks."""
    machines = sorted(tuple(map(int, found)) for found in re.findall(
        r"^neighbours of a (\d+) x \1 mesh, (\d+) cycles, tlab direct +(\d+) KB a transputer +(\d+) ns an event$",
        outputs[0], re.MULTILINE))
    if not machines:
        sys.exit("the benchmarks print no cost of an event")
    machines = [(side * side, *rest) for side, *rest in machines]
    draw_costs(machines, MANUAL / "pictures" / name)
    return (f"![host time of an event](pictures/{name})\n\n"
            + table([["processors", "cycles a round", "KB a transputer", "ns an event"], *machines]))


# Draws the host time of an event twice. The left side shows it against the number of processors, for the most
# frequent number of cycles. The right side shows it against the cycles, for the most frequent number of processors.
def draw_costs(machines, path):
    import matplotlib

    matplotlib.use("svg")
    matplotlib.rcParams.update({"svg.hashsalt": "tlab", "font.size": 9})
    from matplotlib import pyplot

    usual = statistics.mode(cycles for _, cycles, _, _ in machines)
    size = statistics.mode(processors for processors, _, _, _ in machines)
    figure, sides = pyplot.subplots(1, 2, figsize=(8, 3), sharey=True, layout="constrained")
    for side, label, points in (
            (sides[0], "processors", [(m[0], m[3]) for m in machines if m[1] == usual]),
            (sides[1], f"cycles between exchanges, {size} processors", [m[1::2] for m in machines if m[0] == size])):
        side.plot(*zip(*points), "o-")
        side.set(xscale="log", xlabel=label, ylim=(0, None))
        side.grid(alpha=0.3)
    sides[0].set_ylabel("host time of an event, ns")
    figure.savefig(path, metadata={"Date": None})
    pyplot.close(figure)


@a_filter
def ray_costs(outputs, *engines):
    """What a simulated ray costs the host, from `tlab run --profile` with each of the engines."""
    rows = [["point", "events of a ray", *(f"us with `{engine}`" for engine in engines),
             "us of the kernel, not counted in these"]]
    line = re.compile(r"^  (.+?) *: +(-?[\d.]+) us \(kernel ([\d.]+) us\), ([\d.]+) events$", re.MULTILINE)
    found = [line.findall(output) for output in outputs]
    if not all(found):
        sys.exit("tlab run --profile prints no cost of a ray")
    for of_point in zip(*found, strict=True):
        point, _, kernel, events = of_point[-1]
        rows.append([point, events, *(us for _, us, _, _ in of_point), kernel])
    return table(rows)


@a_filter
def confidence(outputs, column):
    """The interval of a column of `tlab run --uncertain`, and the assumptions with the most influence on it."""
    sentence = re.search(rf"^{re.escape(column)}: (.+?) on nine of ten machines(.*)$", outputs[0], re.MULTILINE)
    rows = [["assumption", f"moves `{column}` by"]]
    first, _, others = sentence[2].partition("of the assumptions, ")[2].partition("; then ")
    for part in [first.replace(" matters most:", "").split(" (")[0], *others.split(", ")]:
        if found := re.fullmatch(r"(\S+) (± \S+ %)", part):
            rows.append([f"`{found[1]}`", found[2].replace(" ", "&nbsp;")])
    covered = "".join(f"{line.split(':')[0].split(maxsplit=1)[1]}: {found[0]}.\n\n" for line in outputs[0].split("\n")
                      if (found := re.search(r"\d+ of \d+ where nine of ten machines are(, \d+ with the model's own error \(\S+ ± \S+ %\))?", line)))
    return f"`{column}` varies by {sentence[1]} on nine of ten machines.\n\n" + table(rows) + "\n" + covered


@a_filter
def rankings(_, folder):
    """Table of the best values, and of the number of machines that agree, from `folder`/rankings.csv.

    `tlab run --uncertain` has written this file."""
    with open(ROOT / folder / "rankings.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    about_all = len({row["question"] for row in rows}) == 1
    head = ["at", "best", "on machines", "on the others"]
    return table([head if about_all else ["question", *head]] + [
        ([] if about_all else [prose(row["question"])])
        + [prose(row["at"]), prose(row["best"]), f'{row["machines"]} of {row["of"]}', prose(row["others"])]
        for row in rows])
