#!/usr/bin/env python3
"""Runs the code blocks of README.md and src/doc/*.md exactly as they stand, in a fresh clone of the project.

    capi-tests/readme.py [--work FOLDER] [--target FOLDER] [--vendored FOLDER] [--only NAME.md]

The clone has the committed files with the changes of the working tree. Blocks run in it, those of README.md first. Nothing outside FOLDER
is written: `sudo` is a wrapper that sets DESTDIR, `ldconfig` one that indexes the libraries there, HOME is a separate folder, and git finds
the project under the address in the documents. With --target the clone shares cargo's folder with the working tree; with --vendored the
projects that contain the library share one. Existing builds of the same sources are then reused: for this the files of every clone have the
time stamps of the working tree, by which cargo recognizes them.

A comment before a block says how it is run; a block without one fails the test, unless its language is `text`:

    run: c NAME, run: cpp NAME    written to NAME, compiled under strict warnings, linked by pkg-config, run
    run: sh [NAME=VALUE ...]      run by bash -e in the clone, with the variables in the environment
    run: cmake NAME               a CMakeLists.txt next to the sources of earlier blocks: configured, built, `cube` run
    run: rust                     compiled and run by `cargo test --doc`; the script only checks that src/doc.rs includes the page

A block `text` after `prints` is the stdout of the block before it; after `prints in part`, each of its lines appears there.
Links between documents are followed too.
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
LANGUAGES = {'c': 'c', 'cpp': 'cpp', 'sh': 'sh', 'cmake': 'cmake', 'rust': 'rust'}
STRICT = ['-Wall', '-Wextra', '-Wpedantic', '-Werror']
# The address from which the documents fetch the project.
ADDRESS = 'https://example.org/delotet.git'

SUDO = '''#!/bin/sh
# Root of a separate file system: everything is installed below that folder.
export DESTDIR='{stage}'
exec "$@"
'''
LDCONFIG = '''#!/bin/sh
# Indexes the libraries of that file system.
PATH="$PATH:/sbin:/usr/sbin"
exec "$(PATH="${{PATH#*:}}" command -v ldconfig)" -n "${{DESTDIR:?ldconfig needs root}}"/usr/local/lib*
'''


HOOK = '''#!/bin/sh
# After a checkout of the clone: restores its time stamps.
git ls-files | while IFS= read -r name; do touch -r '{clone}'/"$name" "$name"; done
'''


class Failure(Exception):
    """A block that does not behave as the document says."""


def blocks(text):
    """Line, preceding comment, language and content of each fenced block."""
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


def git(*arguments):
    """Output of git for the project; None if this is not a repository but an unpacked archive."""
    if not (ROOT / '.git').exists():
        return None
    run = subprocess.run(['git', '-C', str(ROOT), *arguments], capture_output=True, text=True)
    return run.stdout if run.returncode == 0 else None


def tracked():
    """The files of the project: those that git tracks or would add, or without git all except builds."""
    names = git('ls-files', '-z', '--cached', '--others', '--exclude-standard')
    if names is not None:
        return [name for name in names.split('\0') if name and (ROOT / name).is_file()]
    return [str(path.relative_to(ROOT)) for path in ROOT.rglob('*')
            if path.is_file() and path.relative_to(ROOT).parts[0] not in ('target', 'build')]


class Runner:
    """Runs blocks in one clone; keeps what the last one printed."""

    def __init__(self, work, target, vendored):
        self.work, self.clone, self.stage = work, work / 'delotet', work / 'root'
        self.printed = ''
        shutil.rmtree(work, ignore_errors=True)
        for folder in ('home', 'root', 'projects'):
            (work / folder).mkdir(parents=True)
        self.make_clone()
        self.tool('tools/sudo', SUDO)
        self.tool('tools/ldconfig', LDCONFIG)
        home = Path.home()
        self.environment = dict(
            os.environ, HOME=str(work / 'home'), PATH=f'{work / "tools"}:{os.environ["PATH"]}',
            CARGO_HOME=os.environ.get('CARGO_HOME', str(home / '.cargo')),
            RUSTUP_HOME=os.environ.get('RUSTUP_HOME', str(home / '.rustup')),
            GIT_CONFIG_GLOBAL=str(work / 'gitconfig'), GIT_CONFIG_NOSYSTEM='1',
            PKG_CONFIG_PATH=':'.join(str(self.stage / 'usr/local' / lib / 'pkgconfig') for lib in ('lib', 'lib64')),
            LD_LIBRARY_PATH=':'.join(str(self.stage / 'usr/local' / lib) for lib in ('lib', 'lib64')),
            CMAKE_PREFIX_PATH=str(self.stage / 'usr/local'))
        # pkg-config would prepend the folder of the file system to paths that already have it.
        self.environment.pop('PKG_CONFIG_SYSROOT_DIR', None)
        self.environment.pop('CARGO_TARGET_DIR', None)
        self.vendored = vendored and vendored.resolve()
        if target:
            (self.clone / 'build').mkdir()
            for folder in (self.clone / 'target', self.clone / 'build/cargo'):
                folder.symlink_to(target.resolve())

    def make_clone(self):
        if git('rev-parse', 'HEAD') is None:
            self.clone.mkdir()
            self.command('git', 'init', '--quiet', cwd=self.clone)
        else:
            self.command('git', 'clone', '--quiet', ROOT, self.clone, cwd=ROOT)
        # The committed files as in the working tree, with their time stamps there.
        for name in self.command('git', 'ls-files', '-z', cwd=self.clone).split('\0')[:-1]:
            (self.clone / name).unlink()
        for name in tracked():
            (self.clone / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, self.clone / name)
        # The tag named in the documents, on the content of the clone.
        version = re.search(r'^version = "(.*)"', (ROOT / 'Cargo.toml').read_text(), re.M).group(1)
        author = ['-c', 'user.name=test', '-c', 'user.email=test@localhost']
        self.command('git', 'add', '--all', cwd=self.clone)
        self.command('git', *author, 'commit', '--quiet', '--allow-empty', '--no-verify', '-m', 'as tested', cwd=self.clone)
        self.command('git', *author, 'tag', '--force', '-m', 'as tested', f'v{version}', cwd=self.clone)
        self.tool('hooks/post-checkout', HOOK)
        (self.work / 'gitconfig').write_text(f'[url "file://{self.clone}"]\n\tinsteadOf = {ADDRESS}\n'
                                             f'[core]\n\thooksPath = {self.work / "hooks"}\n')

    def tool(self, name, text):
        """A program in the folder of all this."""
        path = self.work / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text.format(stage=self.stage, clone=self.clone))
        path.chmod(0o755)

    def command(self, *command, cwd=None, more=None):
        """Runs a command; returns its stdout, or raises a failure with all its output."""
        run = subprocess.run([str(c) for c in command], cwd=cwd or self.clone, capture_output=True, text=True, errors='replace',
                             env=dict(getattr(self, 'environment', os.environ), **(more or {})))
        if run.returncode != 0:
            raise Failure(f'{" ".join(map(str, command))}: exit code {run.returncode}\n{run.stdout}{run.stderr}')
        return run.stdout

    def source(self, compiler, name, content):
        (self.clone / name).write_text(content)
        flags = self.command('pkg-config', '--cflags', '--libs', 'delotet').split()
        program = self.clone / Path(name).stem
        self.command(*compiler, *STRICT, name, '-o', program, *flags)
        self.printed = self.command(program)

    def cmake(self, name, content):
        folder = self.work / 'projects' / name
        build = folder / 'build'
        (folder / 'third_party').mkdir(parents=True)
        (folder / 'third_party/delotet').symlink_to(self.clone)
        for source in self.clone.glob('*.c'):
            shutil.copy(source, folder)
        (folder / 'CMakeLists.txt').write_text(content)
        shared = [f'-DDELOTET_CARGO_TARGET_DIR={self.vendored}'] if self.vendored and name != 'find' else []
        self.command('cmake', '-S', folder, '-B', build, *shared)
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
            raise Failure(f'printed:\n{self.printed}\nthe document says:\n{expected}')

    def block(self, page, note, language, content):
        """Runs the block as its note says; returns the outcome, or None if there was nothing to do."""
        if note in ('prints', 'prints in part'):
            self.check_printed(note != 'prints', content)
            return 'output as shown'
        if language == 'text':
            return None
        kind, _, rest = note.removeprefix('run: ').partition(' ')
        if not note.startswith('run: ') or LANGUAGES.get(kind) != language:
            raise Failure(f'a block of {language or "no language"} after the comment "{note}": how is it run?')
        if kind == 'c':
            self.source(['gcc', '-std=c99'], rest, content)
        elif kind == 'cpp':
            self.source(['g++', '-std=c++17'], rest, content)
        elif kind == 'sh':
            more = dict(word.split('=', 1) for word in rest.split())
            self.printed = self.command('bash', '-e', '-o', 'pipefail', '-c', content, more=more)
        elif kind == 'cmake':
            self.cmake(rest, content)
        elif f'"doc/{page.name}"' not in (ROOT / 'src/doc.rs').read_text():
            raise Failure(f'src/doc.rs does not include {page.name}: cargo test --doc does not run this block')
        return 'ok'


def dead_links(page):
    """Links to files that do not exist; addresses are not followed."""
    text = re.sub(r'^```.*?^```', '', page.read_text(), flags=re.M | re.S)
    found = re.findall(r'\]\(([^)\s]+)\)', text) + re.findall(r'^\[[^\]]+\]: (\S+)', text, re.M)
    return [link for link in found if '://' not in link and not (page.parent / link.partition('#')[0]).exists()]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--work', type=Path, default=ROOT / 'target/readme')
    parser.add_argument('--target', type=Path, help="cargo's folder of the working tree")
    parser.add_argument('--vendored', type=Path, help="a folder for cargo in projects that contain the library")
    parser.add_argument('--only', help='only this document, and README.md before it')
    arguments = parser.parse_args()
    runner = Runner(arguments.work.resolve(), arguments.target, arguments.vendored)
    pages = [ROOT / 'README.md', *sorted((ROOT / 'src/doc').glob('*.md'))]
    count = failed = 0

    def report(place, what, outcome, bad):
        nonlocal count, failed
        count, failed = count + 1, failed + bad
        print(f'{place}: {what}: {outcome}', flush=True)

    for page in pages:
        name = str(page.relative_to(ROOT))
        if arguments.only and page.name not in ('README.md', arguments.only):
            continue
        links = dead_links(page)
        report(name, 'links', f'FAILED: {links}' if links else 'ok', bool(links))
        for line, note, language, content in blocks(page.read_text()):
            try:
                outcome, bad = runner.block(page, note, language, content), False
            except Failure as failure:
                outcome, bad = f'FAILED\n{failure}', True
            if outcome:
                report(f'{name}:{line}', note, outcome, bad)
    print(f'{count - failed} passed, {failed} failed')
    sys.exit(failed != 0 or count == 0)


if __name__ == '__main__':
    main()
