#!/usr/bin/env python3
"""Compares two builds of hawser_bench in one session; exits 1 where the second is slower by more than the margin.

    bench/against.py BASE_PROGRAM PROGRAM [--margin PERCENT] [--filter REGEX]

The two take turns on each group of benchmarks, and the least time of each counts: what else the machine does then falls on both. What still
looks slower is measured again before it is called so. `./dev bench --against COMMIT` builds the first program and calls this.
"""
import argparse
import json
import re
import subprocess
import sys
import tempfile

# Not the program's own work: the machine itself and other solvers. Two threads ask for a quiet machine, a million elements for patience.
LEFT_OUT = re.compile(r'^(machine|threads)/|/(band|sundials|cholmod|umfpack|klu)(/|$)|/1000000$')
ROUNDS, MORE_ROUNDS = 3, 9


def names_of(program):
    listing = subprocess.run([program, '--benchmark_list_tests'], check=True, capture_output=True, text=True).stdout
    return [line for line in listing.splitlines() if line]


def group_of(name):
    """The name without its numbers and settings: what is measured in one go."""
    parts = [part for part in name.split('/') if not part.isdigit() and ':' not in part and part not in ('real_time', 'manual_time')]
    return '/'.join(parts)


def seconds_of(run):
    if 'processor_seconds' in run:
        return run['processor_seconds']
    time = run['real_time'] if run['name'].endswith('real_time') else run['cpu_time']
    return time * {'ns': 1e-9, 'us': 1e-6, 'ms': 1e-3, 's': 1.0}[run['time_unit']]


def measure(program, names, least):
    """Runs these benchmarks and keeps the least time of each. Short repeats find the quiet moments of the machine."""
    pattern = '^(' + '|'.join(re.escape(name).replace(r'\-', '-') for name in names) + ')$'
    with tempfile.NamedTemporaryFile(suffix='.json') as out:
        repeats = 1 if 'manual_time' in names[0] else 7
        subprocess.run([program, f'--benchmark_filter={pattern}', '--benchmark_min_time=0.005', f'--benchmark_repetitions={repeats}',
                        f'--benchmark_out={out.name}', '--benchmark_out_format=json'], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        for run in json.load(open(out.name))['benchmarks']:
            if run.get('error_occurred'):
                sys.exit(f'{program}: {run["name"]}: {run["error_message"]}')
            if run.get('run_type') == 'aggregate':
                continue
            least[run['name']] = min(least.get(run['name'], float('inf')), seconds_of(run))


class Comparison:
    def __init__(self, base, head, margin):
        self.programs = (base, head)
        self.least = ({}, {})
        self.limit = 1.0 + margin / 100.0

    def ratio(self, name):
        return self.least[1][name] / self.least[0][name]

    def slower(self, names):
        return [name for name in names if self.ratio(name) > self.limit]

    def take_turns(self, names, rounds):
        for k in range(rounds):
            for which in (k % 2, 1 - k % 2):
                measure(self.programs[which], names, self.least[which])

    def run(self, names):
        groups = {}
        for name in names:
            groups.setdefault(group_of(name), []).append(name)
        for group, members in groups.items():
            print(group, file=sys.stderr, flush=True)
            self.take_turns(members, ROUNDS)
            for _ in range(MORE_ROUNDS):
                suspects = self.slower(members)
                if not suspects:
                    break
                self.take_turns(suspects, 1)

    def report(self, names):
        print('| benchmark | base, us | now, us | now / base | |\n|---|---|---|---|---|')
        for name in names:
            verdict = 'slower' if self.ratio(name) > self.limit else 'faster' if self.ratio(name) < 1.0 / self.limit else ''
            print(f'| {name} | {self.least[0][name] * 1e6:.4g} | {self.least[1][name] * 1e6:.4g} | {self.ratio(name):.2f} | {verdict} |')


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument('base')
    arguments.add_argument('program')
    arguments.add_argument('--margin', type=float, default=10.0, metavar='PERCENT', help='how much slower is too slow (10)')
    arguments.add_argument('--filter', default='', metavar='REGEX', help='only benchmarks whose names match')
    chosen = arguments.parse_args()
    wanted = [[name for name in names_of(program) if re.search(chosen.filter, name) and not LEFT_OUT.search(name)]
              for program in (chosen.base, chosen.program)]
    both = [name for name in wanted[1] if name in wanted[0]]
    comparison = Comparison(chosen.base, chosen.program, chosen.margin)
    comparison.run(both)
    comparison.report(both)
    for names, others, where in ((wanted[0], wanted[1], 'base'), (wanted[1], wanted[0], 'this build')):
        for name in names:
            if name not in others:
                print(f'only in {where}: {name}')
    if not both:
        sys.exit('no benchmark is in both programs')
    slower = comparison.slower(both)
    print(f'\n{len(both)} benchmarks compared, {len(slower)} slower than base by more than {chosen.margin:g} %')
    sys.exit(1 if slower else 0)


if __name__ == '__main__':
    main()
