#!/usr/bin/env python3
"""Makes the mutants of `mutants.txt`, runs their tests, and tells which were killed.

    tests/mutants/run.py [WORDS]      only mutants whose line holds WORDS

All mutants are built at once, in a copy of the project under target/: each is an `if` that the variable
MUTANT switches. So all of them cost one build, and each a run of its tests.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# A member of a workspace: it takes the project's own builds of its dependencies, and nothing else of it.
WORKSPACE = ROOT / "target" / "mutants"
COPY = WORKSPACE / "copy"
LONGEST = 240  # seconds; an endless loop is a mutant killed

SWITCH = """
/// Whether this mutant is the one that is run.
fn mutant(number: usize) -> bool {
    static CHOSEN: std::sync::OnceLock<usize> = std::sync::OnceLock::new();
    *CHOSEN.get_or_init(|| std::env::var("MUTANT").map_or(0, |text| text.parse().unwrap_or(0))) == number
}
"""


def read():
    """(file, tests, text before, expression, mutated expression, text after) of every mutant."""
    mutants = []
    for line in Path(__file__).with_name("mutants.txt").read_text().splitlines():
        if line.startswith("src/"):
            file, _, tests = line.partition(" | ")
        elif line and not line.startswith("#"):
            before, expression, mutated, after = re.fullmatch(r"(.*)\[\[(.*) => (.*)\]\](.*)", line).groups()
            mutants.append((file, tests.split(), before, expression, mutated, after))
    return mutants


def build(mutants):
    """The copy with all mutants in it, and the test program of the library."""
    shutil.rmtree(COPY, ignore_errors=True)
    COPY.mkdir(parents=True)
    for name in ["Cargo.toml", "README.md", "build.rs", "src", "benches", "docs", "grains"]:
        source = ROOT / name
        (shutil.copytree if source.is_dir() else shutil.copy)(source, COPY / name)
    switches = []
    for number, (file, _, before, expression, mutated, after) in enumerate(mutants, 1):
        text = (COPY / file).read_text()
        plain = before + expression + after
        if text.count(plain) != 1:
            sys.exit(f"{file} has {plain!r} {text.count(plain)} times, not once")
        start = text.index(plain) + len(before)
        switched = f"(if crate::mutant({number}) {{ {mutated} }} else {{ {expression} }})"
        switches.append((file, start, start + len(expression), switched))
    # From the end of each file, so that places do not move.
    for file, start, end, switched in sorted(switches, reverse=True):
        text = (COPY / file).read_text()
        (COPY / file).write_text(text[:start] + switched + text[end:])
    library = COPY / "src" / "lib.rs"
    library.write_text("#![allow(unused_parens)]\n" + library.read_text() + SWITCH)
    shutil.copy(ROOT / "Cargo.lock", WORKSPACE)
    manifest = (ROOT / "Cargo.toml").read_text()
    profiles = re.findall(r"\[profile\.test.*\]\n(?:.+\n)*", manifest)
    quick = "[profile.test.package.grainform]\ncodegen-units = 1\ndebug = false\n"
    (WORKSPACE / "Cargo.toml").write_text("\n".join(['[workspace]\nmembers = ["copy"]\nresolver = "3"\n', *profiles, quick]))
    command = ["cargo", "test", "--lib", "--no-run", "--target-dir", str(ROOT / "target")]
    told = subprocess.run(command, cwd=COPY, stderr=subprocess.PIPE, text=True)
    program = re.search(r"Executable .*\((.*)\)", told.stderr)
    if told.returncode != 0 or not program:
        sys.exit(told.stderr)
    return COPY / program[1]


def passes(program, number, tests):
    """Whether the tests pass with this mutant; none of them run is a mistake of the list."""
    environment = dict(os.environ, MUTANT=str(number), PROPTEST_RNG_SEED="1", PROPTEST_FAILURE_PERSISTENCE="off")
    try:
        told = subprocess.run(
            [program, *tests], cwd=COPY, env=environment, timeout=LONGEST, capture_output=True, text=True
        )
    except subprocess.TimeoutExpired:
        return False
    if "running 0 tests" in told.stdout:
        sys.exit(f"no tests are named {tests}")
    return told.returncode == 0


def main():
    mutants = read()
    program = build(mutants)
    words = " ".join(sys.argv[1:])
    chosen = [
        (number, mutant)
        for number, mutant in enumerate(mutants, 1)
        if words in f"{mutant[0]} {mutant[3]} => {mutant[4]}"
    ]
    for tests in {tuple(mutant[1]) for _, mutant in chosen}:
        if not passes(program, 0, tests):
            sys.exit(f"the tests {tests} fail without a mutant")
    survivors = 0
    for number, (file, tests, _, expression, mutated, _) in chosen:
        survived = passes(program, number, tests)
        survivors += survived
        print(f"{'SURVIVED' if survived else 'killed  '} {file}: {expression} => {mutated}", flush=True)
    print(f"{len(chosen) - survivors} of {len(chosen)} killed")
    sys.exit(1 if survivors else 0)


main()
