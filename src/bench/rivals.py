"""Least-squares expansions of the whole sphere by ducc0, and what they take of one processor.

Standard input: a line of JSON with the number of seen and of hidden points and the largest degree, then theta, phi
and radius of each point as 64-bit floats, the seen ones first. Standard output: a line of JSON for each degree.

Of each degree the solver is given the loosest tolerance, and then the fewest iterations, whose hidden error is within
SLACK of the least: an advantage that nobody has who fits a scan.
"""

import json
import sys
import time

import numpy as np
from ducc0.sht import pseudo_analysis_general, synthesis_general

TOLERANCES = 10.0 ** -np.arange(3, 10)
MOST_ITERATIONS = 500
SLACK = 1.01
BULK = 1 << 17
EXACT = 1e-9


def timed(work):
    """The least and the most seconds of a few runs."""
    seconds = []
    while len(seconds) < 3 or (len(seconds) < 7 and sum(seconds) < 0.2):
        started = time.process_time()
        work()
        seconds.append(time.process_time() - started)
    return [min(seconds), max(seconds)]


def real(alm, degree):
    """Coefficients of the real orthonormal harmonics without the Condon-Shortley phase, that of l and m at l(l+1) + m."""
    found = np.empty((degree + 1) ** 2)
    at = 0
    for m in range(degree + 1):
        l = np.arange(m, degree + 1)
        own = alm[at : at + l.size] * ((-1) ** m * np.sqrt(2.0) if m else 1.0)
        at += l.size
        found[l * (l + 1) - m] = -own.imag
        found[l * (l + 1) + m] = own.real
    return found


def rival(degree, seen, hidden, anywhere):
    """The fit of a degree, as one object."""

    def fit(tolerance, iterations):
        return pseudo_analysis_general(
            lmax=degree, mmax=degree, spin=0, loc=seen[:, :2], map=seen[None, :, 2], nthreads=1,
            epsilon=tolerance, maxiter=iterations,
        )

    def radii(alm, places, tolerance):
        return synthesis_general(
            lmax=degree, mmax=degree, spin=0, loc=places, alm=alm, nthreads=1, epsilon=tolerance
        )[0]

    def error(solution):
        return np.sqrt(np.mean((radii(solution[0], hidden[:, :2], EXACT) - hidden[:, 2]) ** 2))

    solutions = [fit(tolerance, MOST_ITERATIONS) for tolerance in TOLERANCES]
    errors = [error(solution) for solution in solutions]
    enough = SLACK * min(errors)
    loosest = next(i for i in range(len(errors)) if errors[i] <= enough)
    tolerance, fewest = TOLERANCES[loosest], solutions[loosest][2]
    while fewest > 1 and error(fit(tolerance, fewest - 1)) <= enough:
        fewest -= 1
    alm = fit(tolerance, fewest)[0]
    return {
        "degree": degree,
        "seconds": timed(lambda: fit(tolerance, fewest)),
        "nanoseconds": 1e9 * timed(lambda: radii(alm, anywhere[:1], tolerance))[0],
        "nanoseconds_bulk": 1e9 / BULK * timed(lambda: radii(alm, anywhere, tolerance))[0],
        "coefficients": real(alm[0], degree).tolist(),
    }


def main():
    asked = json.loads(sys.stdin.buffer.readline())
    points = np.frombuffer(sys.stdin.buffer.read(), dtype="<f8").reshape(-1, 3)
    seen, hidden = points[: asked["seen"]], points[asked["seen"] :]
    random = np.random.default_rng(0)
    anywhere = np.stack(
        [np.arccos(random.uniform(-1.0, 1.0, BULK)), random.uniform(0.0, 2.0 * np.pi, BULK)], axis=1
    )
    for degree in range(1, asked["degree"] + 1):
        print(json.dumps(rival(degree, seen, hidden, anywhere)), flush=True)


main()
