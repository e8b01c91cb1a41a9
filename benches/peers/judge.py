"""How an answer is judged, the same for every program."""
import math

import numpy as np

# Hair is inextensible to the eye: a setting that stretches it by more is no setting.
STRETCH = 0.01
# Energy that may be gained, in units of the weight times the length.
GAIN = 0.25


def record_times(case, rate):
    """(steps a record, times of the records): every 1/60 s, or every step where steps are longer."""
    every = max(1, rate // 60)
    interval = every / rate
    return every, [interval * (k + 1) for k in range(math.floor(case.seconds / interval + 1e-9))]


def stretch(answer):
    return max(abs(length - 1) for length in answer["lengths"])


def errors(answer, case, rate, truth):
    """The tip's largest and its last distance from the truth at the records, over the length."""
    _, times = record_times(case, rate)
    right = truth[[round(60 * time) - 1 for time in times]]
    tips = np.array(answer["tips"], dtype=float)
    distances = np.linalg.norm(tips - right, axis=1) / case.length
    return float(distances.max()), float(distances[-1])


def energy_gain(answer, case, step):
    """The most that kinetic and gravity's energy rose above the start, over weight times length."""
    start = np.array(answer["start"], dtype=float)
    weights = np.full(len(start), 1.0 / (len(start) - 1))
    weights[[0, -1]] /= 2
    most = 0.0
    for before, after in np.array(answer["pairs"], dtype=float):
        speeds = np.linalg.norm(after - before, axis=1) / step
        most = max(most, float(weights @ (0.5 * speeds**2 / case.gravity + after[:, 2] - start[:, 2]) / case.length))
    return most


def verdict(answer, case, step):
    """(it stayed finite and gained no energy, its length was kept too, most stretch, most gain)."""
    if "pairs" not in answer:
        return False, False, math.inf, math.inf
    gain, most = energy_gain(answer, case, step), stretch(answer)
    holds = math.isfinite(gain) and gain < GAIN
    return holds, holds and most < STRETCH, most, gain
