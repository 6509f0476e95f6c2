"""Figures in the guide: the scripts that measure write their tables into src/doc/figures.md, between marks, with date and machine.

    <!-- figures: NAME -->
    Measured ...: COMMAND

    | table |
    <!-- /figures -->

A script passes its parser to `add_options`, and its table to `publish` at the end: with --write the table replaces the one in the page;
with --check it must equal it (for tables of counts, which are the same everywhere).
"""
import os
import platform
import re
import sys
import time

PAGE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "src", "doc", "figures.md")


def add_options(parser):
    parser.add_argument("--write", action="store_true", help="write the table into the guide's page of figures")
    parser.add_argument("--check", action="store_true", help="fail if the table on that page is another one")
    parser.add_argument("--page", default=PAGE, help="another page than src/doc/figures.md")


def table(heads, rows):
    """A table of Markdown; numbers stand on the right. Thousands are separated in whole numbers."""
    cell = lambda x: f"{x:,}" if isinstance(x, int) else "" if x is None else str(x)
    right = lambda i: all(re.fullmatch(r"[-\d.,e]*", cell(row[i])) for row in rows)
    lines = [heads, ["--:" if right(i) else "---" for i in range(len(heads))]] + [[cell(x) for x in row] for row in rows]
    return "".join("| " + " | ".join(line) + " |\n" for line in lines)


def processor():
    try:
        names = [line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")]
    except OSError:
        names = []
    return f"{os.cpu_count()} processors ({names[0] if names else platform.machine()})"


def block(text, name):
    """Where the figures of this name stand in the page: (start, end) of what is between the marks."""
    begin = text.find(f"<!-- figures: {name} -->\n")
    if begin < 0:
        raise SystemExit(f"the page has no figures of the name {name}")
    begin = text.index("\n", begin) + 1
    return begin, text.index("<!-- /figures -->", begin)


def rows(text):
    return [line for line in text.splitlines() if line.startswith("|")]


def command():
    """The command that runs now, as somebody else would write it: without what concerns this run and this folder alone."""
    words, given = [], iter(sys.argv[1:])
    for word in given:
        if word in ("--page", "--tsv", "--keep", "--folder", "--mmg"):
            next(given, None)
        elif word == "--bin":
            next(given, None)
            words.append("--bin target/release/delotet")
        elif word not in ("--write", "--check"):
            words.append(word)
    script = os.path.relpath(os.path.abspath(sys.argv[0]), os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
    return " ".join(["python3", script, *words])


def publish(options, name, content):
    """Writes or checks the figures `name`; 0, or 1 if they are not those of the page."""
    text = open(options.page).read()
    begin, end = block(text, name)
    if options.check and rows(text[begin:end]) != rows(content):
        print(f"the page has other figures of the name {name}; to renew them: {command()} --write", file=sys.stderr)
        print("\n".join(["it has:", *rows(text[begin:end]), "measured:", *rows(content)]), file=sys.stderr)
        return 1
    if options.write:
        head = f"Measured on {time.strftime('%Y-%m-%d')}, {processor()}: `{command()}`.\n\n"
        with open(options.page, "w") as page:
            page.write(text[:begin] + head + content + text[end:])
    return 0
