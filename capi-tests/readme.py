#!/usr/bin/env python3
"""Runs the code blocks of README.md as they stand, against an installed delotet.

    capi-tests/readme.py PREFIX [--bin delotet] [--cargo FOLDER] [--work FOLDER]

A comment before a block says what is done with it; a block without one fails the test, unless its language is `text`:

    run: c NAME, run: cpp NAME    written to NAME, compiled under strict warnings, linked by pkg-config, run
    run: sh             run by bash -e, in the folder of all blocks, with PREFIX, PKG_CONFIG_PATH and LD_LIBRARY_PATH set
    run: cli            the same; `cargo run --release --` is the program of --bin (without it the block is skipped, loudly)
    run: cmake NAME     a CMakeLists.txt beside the sources of the blocks before it: configured, built, `cube` run
    run: rust           run by `cargo test --doc`, nothing here
    not run: REASON     nothing

A block `text` after `prints` is what the block before it wrote to stdout; `prints in part`: each of its lines appears there.
`--cargo`: what cargo built for this folder's CMake build, so that the projects which contain the library need not build it anew.
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
LANGUAGES = {'c': 'c', 'cpp': 'cpp', 'sh': 'sh', 'cli': 'sh', 'cmake': 'cmake', 'rust': 'rust'}
STRICT = ['-Wall', '-Wextra', '-Wpedantic', '-Werror']


class Failure(Exception):
    """A block that does not do what the README says."""


def blocks(text):
    """Line, comment before, language and content of each fenced block."""
    lines = text.split('\n')
    at = 0
    while at < len(lines):
        if lines[at].startswith('```'):
            start, language = at, lines[at][3:].strip()
            while at + 1 < len(lines) and lines[at + 1] != '```':
                at += 1
            before = re.fullmatch(r'<!-- (.*) -->', lines[start - 1]) if start else None
            yield start + 1, before.group(1) if before else '', language, '\n'.join(lines[start + 1:at + 1]) + '\n'
            at += 1
        at += 1


class Runner:
    """Runs blocks in one folder; keeps what the last one printed."""

    def __init__(self, args):
        self.work, self.bin, self.cargo = args.work, args.bin, args.cargo
        self.prefix = args.prefix.resolve()
        self.environment = dict(os.environ, PREFIX=str(self.prefix),
                                PKG_CONFIG_PATH=str(self.prefix / 'lib/pkgconfig'),
                                LD_LIBRARY_PATH=str(self.prefix / 'lib'))
        self.printed = ''
        shutil.rmtree(self.work, ignore_errors=True)
        self.work.mkdir(parents=True)
        # Paths in the README are relative to the project; what is written stays here.
        (self.work / 'capi-tests').mkdir()
        (self.work / 'capi-tests/data').symlink_to(ROOT / 'capi-tests/data')

    def command(self, *command):
        """Runs a command; its stdout, or a failure with all it said."""
        run = subprocess.run([str(c) for c in command], cwd=self.work, env=self.environment, capture_output=True, text=True)
        if run.returncode != 0:
            raise Failure(f'{" ".join(map(str, command))}: exit code {run.returncode}\n{run.stdout}{run.stderr}')
        return run.stdout

    def source(self, compiler, name, content):
        (self.work / name).write_text(content)
        flags = self.command('pkg-config', '--cflags', '--libs', 'delotet').split()
        program = self.work / Path(name).stem
        self.command(*compiler, *STRICT, name, '-o', program, *flags)
        self.printed = self.command(program)

    def shell(self, content):
        self.printed = self.command('bash', '-e', '-o', 'pipefail', '-c', content)

    def cmake(self, name, content):
        folder, build = self.work / name, self.work / name / 'build'
        folder.mkdir()
        for source in self.work.glob('*.c'):
            shutil.copy(source, folder)
        # The folder that a project would hold, and the repository that it would fetch from, are this one.
        (folder / 'CMakeLists.txt').write_text(content.replace('third_party/delotet', str(ROOT)))
        inside = {'subdirectory': 'delotet', 'fetch': '_deps/delotet-build'}.get(name)
        if self.cargo and inside:
            (build / inside).mkdir(parents=True)
            self.command('cp', '-a', self.cargo.resolve(), build / inside / 'cargo')
        self.command('cmake', '-S', folder, '-B', build, f'-DCMAKE_PREFIX_PATH={self.prefix}',
                     f'-DFETCHCONTENT_SOURCE_DIR_DELOTET={ROOT}')
        self.command('cmake', '--build', build)
        printed = self.command(build / 'cube')
        if 'tetrahedra' not in printed:
            raise Failure(f'cube printed: {printed}')

    def check_printed(self, partly, expected):
        if partly:
            missing = [line for line in expected.splitlines() if line not in self.printed.splitlines()]
            if missing:
                raise Failure('\n'.join(['printed:', self.printed, 'missing:', *missing]))
        elif self.printed.strip() != expected.strip():
            raise Failure(f'printed:\n{self.printed}\nthe README says:\n{expected}')

    def block(self, note, language, content):
        """Does what the note says; returns what was done."""
        if note in ('prints', 'prints in part'):
            self.check_printed(note != 'prints', content)
            return 'output as shown'
        if language == 'text' or note.startswith('not run: '):
            return 'not run'
        kind, _, name = note.removeprefix('run: ').partition(' ')
        if not note.startswith('run: ') or LANGUAGES.get(kind) != language:
            raise Failure(f'a block of {language or "no language"} after the comment "{note}": is it run or not?')
        if kind == 'c':
            self.source(['gcc', '-std=c99'], name, content)
        elif kind == 'cpp':
            self.source(['g++', '-std=c++17'], name, content)
        elif kind == 'sh':
            self.shell(content)
        elif kind == 'cmake':
            self.cmake(name, content)
        elif kind == 'rust':
            return 'by cargo test --doc'
        elif not self.bin:
            self.printed = None
            return 'SKIPPED: no --bin'
        else:
            self.shell(content.replace('cargo run --release --', str(self.bin.resolve())))
        return 'ok'


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('prefix', type=Path)
    parser.add_argument('--bin', type=Path)
    parser.add_argument('--cargo', type=Path)
    parser.add_argument('--work', type=Path, default=ROOT / 'target/readme')
    runner = Runner(parser.parse_args())
    count = failed = 0
    for line, note, language, content in blocks((ROOT / 'README.md').read_text()):
        if runner.printed is None and note.startswith('prints'):
            continue
        try:
            outcome = runner.block(note, language, content)
        except Failure as failure:
            failed += 1
            outcome = f'FAILED\n{failure}'
        if outcome != 'not run':
            count += 1
            print(f'README.md:{line}: {note}: {outcome}', flush=True)
    print(f'{count - failed} passed, {failed} failed')
    sys.exit(failed != 0 or count == 0)


if __name__ == '__main__':
    main()
