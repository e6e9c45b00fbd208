#!/usr/bin/env python3
"""The tables of bench/README.md in Markdown, from the JSON of Google Benchmark; and the data of its charts.

    bench/tables.py out/bench/hawser_bench.json [MORE.json ...]      prints all tables
    bench/tables.py --data FOLDER out/bench/hawser_bench.json        also writes what is kept: FOLDER/least.json, which this program reads as
                                                                     well, and the data of the charts FOLDER/{newton,stages,threads,roofline,roofs}.csv

Of repeated benchmarks the least time counts. A table whose benchmarks are not in the files is left out.
"""
import argparse
import json
import os

SOLVERS = {'chain': 'chain', 'band': 'band (LAPACK)', 'sundials': 'SUNDIALS, SUNLinSol_Band', 'cholmod': 'CHOLMOD, symmetric part',
           'umfpack': 'UMFPACK', 'klu': 'KLU, refactorization'}
FAMILIES = ('bar', 'cable', 'beam')
STAGES = {'residual': 'assembly/residual/beam/wet', 'tangent': 'assembly/tangent/beam/wet', 'factorize': 'linear/factorize/chain',
          'solve': 'linear/solve/chain', 'full iteration': 'newton/full/chain/beam',
          'full, factors kept': 'newton/kept/chain/beam', 'full, assembly first': 'newton/apart/chain/beam', 'reused': 'newton/reused/chain/beam'}

THREAD_STAGES = ('residual', 'tangent', 'factorize', 'solve', 'newton')


def rate_time(run):
    return run.get('s_per_element', run['cpu_time'])


def load(paths):
    """Name -> the run with the least time; and the facts of the machine."""
    runs, context = {}, {}
    for path in paths:
        with open(path) as file:
            document = json.load(file)
        context = document['context']
        for run in document['benchmarks']:
            if run.get('run_type') == 'aggregate' or run.get('error_occurred'):
                continue
            name = run['run_name']
            if name not in runs or rate_time(run) < rate_time(runs[name]):
                runs[name] = run
    return runs, context


def number(value, digits=2):
    """Two significant digits, without exponent down to 0.001."""
    if value is None:
        return ''
    return f'{value:#.{digits}g}'.rstrip('.') if value < 100 else f'{value:.0f}'


def power(size):
    superscript = str.maketrans('0123456789', '⁰¹²³⁴⁵⁶⁷⁸⁹')
    return '10' + str(len(str(size)) - 1).translate(superscript)


def table(title, head, rows):
    if not any(cell for row in rows for cell in row[1:]):
        return
    print(f'\n{title}\n')
    print('| ' + ' | '.join(head) + ' |')
    print('|' + '---|' * len(head))
    for row in rows:
        print('| ' + ' | '.join(row) + ' |')


class Results:
    def __init__(self, runs):
        self.runs = runs

    def microseconds(self, name, suffix=''):
        """Of an element; None where it was not measured."""
        run = self.runs.get(name + suffix)
        return run and run['s_per_element'] * 1e6

    def counter(self, name, key):
        run = self.runs.get(name)
        return run and run.get(key)

    def sizes(self, name):
        return sorted(int(n.split('/')[-1]) for n in self.runs if n.rsplit('/', 1)[0] == name)

    def cell(self, name, scale=1.0):
        value = self.microseconds(name)
        return '' if value is None else number(value * scale)


def assembly(r):
    sizes = (1000, 10000, 100000)
    kinds = [(task, water) for task in ('residual', 'tangent') for water in ('dry', 'wet')]
    head = [''] + [f'{"with tangent" if task == "tangent" else task}, {water}, {power(n)}' for task, water in kinds for n in sizes]
    rows = [[family] + [r.cell(f'assembly/{task}/{family}/{water}/{n}') for task, water in kinds for n in sizes] for family in FAMILIES]
    table('Assembly, microseconds of an element:', head, rows)


def linear(r):
    sizes = (1000, 10000, 100000)
    rows = []
    for solver, label in SOLVERS.items():
        errors = [r.counter(f'linear/both/{solver}/{n}', 'backward_error') for n in sizes]
        errors = [e for e in errors if e is not None]
        both, chain = r.microseconds(f'linear/both/{solver}/1000'), r.microseconds('linear/both/chain/1000')
        rows.append([label] + [r.cell(f'linear/{task}/{solver}/{n}') for task in ('factorize', 'solve') for n in sizes] +
                    [number(both / chain) if both and chain else '', f'{max(errors):.0e}' if errors else '',
                     number(r.counter(f'linear/factorize/{solver}/10000', 'bytes_per_element'))])
    head = ['solver'] + [f'{task} {power(n)}' for task in ('factorize', 'solve') for n in sizes]
    table('Linear solvers on the same assembled beam in water, microseconds of an element:', head + ['both at 10³, over chain', 'backward error', 'bytes an element'],
          rows)


def newton(r):
    sizes = (1000, 10000, 100000, 1000000)
    head = ['solver'] + [f'{kind} {power(n)}' for kind in ('full', 'reused') for n in sizes] + ['backward error']
    rows = []
    for solver, label in SOLVERS.items():
        for family in reversed(FAMILIES):
            errors = [r.counter(f'newton/full/{solver}/{family}/{n}', 'backward_error') for n in sizes]
            errors = [e for e in errors if e is not None]
            if errors:
                rows.append([f'{label}, {family}'] + [r.cell(f'newton/{kind}/{solver}/{family}/{n}') for kind in ('full', 'reused') for n in sizes] +
                            [f'{max(errors):.0e}'])
    table('Newton iteration, microseconds of an element:', head, rows)


def stages(r):
    sizes = (100, 1000, 10000, 100000, 1000000)
    rows = [[stage] + [r.cell(f'{name}/{n}') for n in sizes] for stage, name in STAGES.items()]
    table('Every stage of the beam in water with the chain solver, microseconds of an element:', ['stage'] + [power(n) for n in sizes], rows)


def threads(r):
    sizes = (1000, 10000, 100000)
    rows = []
    for stage in THREAD_STAGES:
        row = [stage]
        for n in sizes:
            one, two = (r.microseconds(f'threads/{stage}/{n}/{count}', '/real_time') for count in (1, 2))
            row += [number(one), number(two), number(one / two)] if one and two else ['', '', '']
        rows.append(row)
    head = ['stage'] + [f'{power(n)}{word}' for n in sizes for word in (', one thread', ', two', ', gain')]
    table('Threads, wall microseconds of an element; results are the same bits:', head, rows)


def points(r):
    """Of the roofline: (stage, elements, operations, bytes, operations per byte, operations per second)."""
    for stage, name in list(STAGES.items())[:4]:
        for n in r.sizes(name):
            run = r.runs[f'{name}/{n}']
            if 'flops_per_element' in run:
                work, moved = run['flops_per_element'], run.get('moved_per_element', run['bytes_per_element'])
                yield stage, n, work, moved, work / moved, work / run['s_per_element']


def roofs(r, context):
    peak = r.counter(f'machine/peak/{context.get("kernels")}', 'flops_per_second')
    bandwidth = {int(n.split('/')[-1]): run['bytes_per_second'] for n, run in r.runs.items() if n.startswith('machine/bandwidth/')}
    return peak, dict(sorted(bandwidth.items()))


def roofline(r, context):
    peak, bandwidth = roofs(r, context)
    if not peak or not bandwidth:
        return
    levels = ', '.join(f'{number(rate * 1e-9)} GB/s over {kib} KiB' for kib, rate in bandwidth.items())
    rows = [[stage, power(n), f'{work:.0f}', f'{moved:.0f}', number(ratio), number(speed * 1e-9), f'{100 * speed / peak:.0f} %']
            for stage, n, work, moved, ratio, speed in points(r) if n in (1000, 100000)]
    table(f'Roofline ({context.get("kernels")}): peak {number(peak * 1e-9)} Gflop/s; {levels}.',
          ['stage', 'elements', 'operations', 'bytes', 'operations a byte', 'Gflop/s', 'of the peak'], rows)


def steps(r):
    sizes = (100, 1000, 10000)
    rows = [[family] + [r.cell(f'time_step/{family}/{n}') for n in sizes] +
            [number(r.counter(f'time_step/{family}/1000', 'iterations'), 3)] for family in FAMILIES]
    table('A time step of `umbilical-heave`, microseconds of an element:', ['family'] + [power(n) for n in sizes] + ['iterations a step'], rows)


def scenes(r):
    rows = []
    for name, run in r.runs.items():
        if name.startswith('static/'):
            _, scene, n = name.split('/')
            rows.append([f'static `{scene}`', n, number(run['cpu_time'] * 1e-3), '', '', ''])
        if name.startswith('run/'):
            scene, n = name.split('/')[1:3]
            rows.append([f'run `{scene}`, whole process', n, number(run['processor_seconds']), number(run['wall_seconds']),
                         number(run['newton_iterations'] / run['steps'], 3), number(run['factorizations'] / run['steps'], 3)])
    table('Scenes, seconds:', ['scene', 'elements', 'processor time', 'wall time', 'iterations a step', 'factorizations a step'], rows)


def offsets(r):
    rows = [[name.split('/', 1)[1].replace('/', ', offsets up to ') + ' m', number(run['s_per_offset'] * 1e3), number(run['s_per_offset'] * 1e5 / 60),
             number(run['iterations'], 3), f'{run["failed"]:.0f}'] for name, run in r.runs.items() if name.startswith('offsets/')]
    if rows:
        table('Maps of end offsets, 200 elements in a current on a bed, one thread:',
              ['line', 'milliseconds an offset', 'minutes for 100 000', 'factorizations an offset', 'failed'], rows)


def methods(r):
    rows = []
    for scene in (name.split('/')[2] for name in r.runs if name.startswith('method/newton/')):
        cells = []
        for method in ('newton', 'kinsol'):
            run = r.runs.get(f'method/{method}/{scene}')
            cells += [number(run['cpu_time']), f'{run["factorizations"]:.0f}'] if run else ['', '']
        rows.append([f'`{scene}`'] + cells)
    table('An equilibrium from its own start, without reading and meshing:',
          ['scene', 'Newton, ms', 'factorizations', 'KINSOL, ms', 'factorizations'], rows)


STARTS = {'newton/catenary': 'Newton, catenary', 'newton/straight': 'Newton, straight',
          'kinsol/catenary': 'KINSOL, catenary', 'kinsol/straight': 'KINSOL, straight'}


def equilibria(r):
    sizes = r.sizes('equilibrium/newton/catenary')
    rows = []
    for route, label in STARTS.items():
        runs = [r.runs.get(f'equilibrium/{route}/{n}') for n in sizes]
        rows.append([label] + [f'{number(run["cpu_time"])} ({run["factorizations"]:.0f})' if run and 'factorizations' in run else '' for run in runs])
    if sizes:
        table('`catenary-5000` by method and start, milliseconds (factorizations):', ['elements'] + [power(n) for n in sizes], rows)


def write(folder, name, head, rows):
    with open(os.path.join(folder, name), 'w') as file:
        file.write(head + '\n')
        for row in rows:
            file.write(','.join(str(x) for x in row) + '\n')


def write_data(r, context, folder):
    with open(os.path.join(folder, 'least.json'), 'w') as file:
        facts = {key: value for key, value in context.items() if key not in ('host_name', 'executable')}
        kept = [{key: value for key, value in run.items() if 'index' not in key and key not in ('repetitions', 'run_type', 'threads')}
                for run in r.runs.values()]
        json.dump({'context': facts, 'benchmarks': kept}, file, indent=1)
        file.write('\n')
    write(folder, 'newton.csv', 'solver,kind,elements,microseconds_per_element',
          [(solver, kind, n, f'{r.microseconds(f"newton/{kind}/{solver}/beam/{n}"):.4e}')
           for kind in ('full', 'reused') for solver in SOLVERS for n in r.sizes(f'newton/{kind}/{solver}/beam')])
    write(folder, 'stages.csv', 'stage,elements,microseconds_per_element',
          [(stage, n, f'{r.microseconds(f"{name}/{n}"):.4e}') for stage, name in STAGES.items() for n in r.sizes(name)])
    write(folder, 'equilibria.csv', 'route,elements,microseconds_per_element',
          [(route, n, f'{r.microseconds(f"equilibrium/{route}/{n}"):.4e}') for route in STARTS for n in r.sizes(f'equilibrium/{route}')
           if r.microseconds(f'equilibrium/{route}/{n}')])
    sizes = (1000, 10000, 100000)
    write(folder, 'threads.csv', 'stage,' + ','.join(f'wall microseconds per element of {n} with {count}' for n in sizes for count in (1, 2)),
          [[stage] + [r.microseconds(f'threads/{stage}/{n}/{count}', '/real_time') for n in sizes for count in (1, 2)]
           for stage in THREAD_STAGES if f'threads/{stage}/1000/1/real_time' in r.runs])
    write(folder, 'roofline.csv', 'stage,elements,flops_per_byte,gflops_per_second',
          [(stage, n, f'{ratio:.4f}', f'{speed * 1e-9:.4f}') for stage, n, _, _, ratio, speed in points(r)])
    peak, bandwidth = roofs(r, context)
    write(folder, 'roofs.csv', 'roof,value', [('peak', f'{peak * 1e-9:.2f}')] * bool(peak) + [(kib, f'{rate * 1e-9:.2f}') for kib, rate in bandwidth.items()])


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument('json', nargs='+')
    arguments.add_argument('--data', metavar='FOLDER', help='write the data of the charts there')
    chosen = arguments.parse_args()
    runs, context = load(chosen.json)
    r = Results(runs)
    print(f'{context.get("processor")}, {context["num_cpus"]} cores, {context.get("kernels")} kernels, compiler {context.get("compiler")}, '
          f'load {context["load_avg"][0]:.1f}, {context["date"]}')
    for part in (assembly, linear, newton, stages, threads):
        part(r)
    roofline(r, context)
    steps(r)
    scenes(r)
    offsets(r)
    methods(r)
    equilibria(r)
    if chosen.data:
        write_data(r, context, chosen.data)


if __name__ == '__main__':
    main()
