"""Spectra of signals over time: amplitudes, power spectral density, orders of a speed.

Signals at uneven times are resampled by cubic splines at their median step. The mean is taken off.
    amplitude   |X|: a sine of amplitude A shows A. The flat-top window makes this so between the lines of the spectrum
                as well, to 0.1 %; peaks are 3.8 lines wide, the resolution is 3.8/T.
    psd         by Welch's method (Hann windows that overlap by half): the integral over the frequency is the mean
                square.
    orders      the signal over the angle of a speed, cut into pieces that overlap by half; amplitudes as above.
References: G. Heinzel, A. Ruediger, R. Schilling, Spectrum and spectral density estimation by the DFT, 2002;
P. D. Welch, IEEE Trans. Audio Electroacoust. AU-15 (1967) 70-73; K. R. Fyfe, E. D. S. Munck, Mech. Syst. Signal
Process. 11 (1997) 187-205 (resampling over the angle).
"""

import dataclasses

import numpy as np
from scipy import signal
from scipy.interpolate import CubicSpline

from ..messages import InputError

LEAST_ROWS = 16
MOST_POINTS = 20_000_000
FLAT_TOP = 3.77  # noise bandwidth of the window in lines
EVEN = 1e-6      # relative deviation of steps that counts as rounding


@dataclasses.dataclass
class Spectrum:
    """x: frequencies [Hz] or orders; values (n); resolution in units of x; remarks: what was done to the signal"""

    x: np.ndarray
    values: np.ndarray
    resolution: float
    remarks: list


def even_signal(time, values, what):
    """A signal at even steps: step, values, remarks. A signal with gaps gives its longest part without one.
    @raises InputError if too little is left, or if the times do not increase"""
    begin, end = _longest_part(time, values, what)
    remarks = [] if end - begin == len(values) else \
        [f"of {len(values)} rows the longest part without a gap: {end - begin} from {time[begin]:.6g} to "
         f"{time[end - 1]:.6g}"]
    step, even, more = resampled(time[begin:end], values[begin:end], what)
    return step, even, remarks + more


def even_channels(time, values, names):
    """Signals (nt, channels) without gaps at even steps: step, values, remarks. @raises InputError"""
    if len(time) < 2:
        raise InputError(f"{names[0]}: there is one time only; a step needs two")
    for name, column in zip(names, values.T):
        if not np.isfinite(column).all():
            gap = time[int(np.argmin(np.isfinite(column)))]
            raise InputError(f"'{name}' has no number at {gap:g} s; channels have no gaps: leave it out, or take "
                             "another --span")
    return resampled(time, values, names[0])


def resampled(time, values, what):
    """Signals (nt, ..) at even steps, by cubic splines at the median step unless their steps are even: step, values,
    remarks. @raises InputError if the times do not increase"""
    steps = np.diff(time)
    if np.any(steps <= 0):
        row = int(np.flatnonzero(steps <= 0)[0])
        raise InputError(f"{what}: even steps need times that increase: after {time[row]:g} comes {time[row + 1]:g}")
    step = (time[-1] - time[0]) / len(steps)
    if np.abs(steps - step).max() <= EVEN * step:
        return step, values, []
    count = max(int(round((time[-1] - time[0]) / np.median(steps))), 1)
    step = (time[-1] - time[0]) / count
    return step, CubicSpline(time, values)(np.linspace(time[0], time[-1], count + 1)), \
        [f"resampled from steps of {steps.min():.3g} to {steps.max():.3g} s at {step:.4g} s"]


def _longest_part(time, values, what):
    """First row, and the one after the last, of the longest part without a gap. @raises InputError if it is too
    short"""
    known = np.flatnonzero(np.isfinite(values) & np.isfinite(time))
    longest = max(np.split(known, np.flatnonzero(np.diff(known) > 1) + 1), key=len)
    if len(longest) < LEAST_ROWS:
        raise InputError(f"{what}: a spectrum needs {LEAST_ROWS} rows without a gap; there are {len(longest)}")
    return int(longest[0]), int(longest[-1]) + 1


def amplitudes(values):
    """(.., n // 2 + 1) amplitudes of (.., n) values at even steps: lines k / n of the sampling rate."""
    count = values.shape[-1]
    window = signal.windows.flattop(count, sym=False)
    found = 2 * np.abs(np.fft.rfft((values - values.mean(axis=-1, keepdims=True)) * window)) / window.sum()
    found[..., 0] /= 2
    if count % 2 == 0:
        found[..., -1] /= 2  # the highest line has no mirror image
    return found


def amplitude_spectrum(time, values, what):
    """@returns Spectrum of amplitudes over the frequency. @raises InputError"""
    step, even, remarks = even_signal(time, values, what)
    return Spectrum(np.fft.rfftfreq(len(even), step), amplitudes(even), FLAT_TOP / (len(even) * step), remarks)


def power_density(time, values, what):
    """@returns Spectrum of the power spectral density [unit^2/Hz]: its integral is the variance of the signal.
    @raises InputError"""
    step, even, remarks = even_signal(time, values, what)
    length = min(len(even), max(256, len(even) // 8))
    frequency, density = signal.welch(even - even.mean(), 1 / step, "hann", length, length // 2, detrend=False)
    return Spectrum(frequency, density, 1.5 / (length * step), remarks + [f"pieces of {length} rows"])


@dataclasses.dataclass
class Orders:
    """speed (p) mean of each piece [rad/s]; order (n); amplitude (p,n); resolution in orders"""

    speed: np.ndarray
    order: np.ndarray
    amplitude: np.ndarray
    resolution: float


def order_analysis(time, values, speed, what):
    """Amplitudes over the speed [rad/s] and its orders, in pieces of an eighth of all revolutions, 4 at least and 20 at
    most. The angle is divided so finely that nothing is lost where the speed is least; orders go up to half the rows
    per revolution where it is largest. @raises InputError if the speed changes its sign, or makes too few revolutions"""
    begin, end = _longest_part(time, np.where(np.isfinite(speed), values, np.nan), what)
    time, values, speed = time[begin:end], values[begin:end], _one_way(speed[begin:end], what)
    if np.any(np.diff(time) <= 0):
        raise InputError(f"{what}: an order analysis needs times that increase")
    angle = CubicSpline(time, speed).antiderivative()(time) / (2 * np.pi)  # revolutions
    revolutions = int(np.clip(angle[-1] // 8, 4, 20))
    if angle[-1] < revolutions:
        raise InputError(f"{what}: the speed makes {angle[-1]:.3g} revolutions; an order analysis needs {revolutions}")
    coarse, fine = int(1 / np.diff(angle).max() + EVEN), int(np.ceil(1 / np.diff(angle).min()))  # rows per revolution
    if coarse < 4:
        raise InputError(f"{what}: {coarse} rows per revolution are too few for an order analysis")
    if angle[-1] * fine > MOST_POINTS:
        raise InputError(f"{what}: the speed varies too much for an order analysis of all of it: take a --span in "
                         "which it is faster")
    length = fine * revolutions
    places = np.arange(int(angle[-1] * fine) + 1) / fine
    turned, when = CubicSpline(angle, values)(places), CubicSpline(angle, time)(places)
    starts = range(0, len(places) - length + 1, length // 2)
    orders = np.arange(coarse * revolutions // 2 + 1)
    found = np.array([amplitudes(turned[k:k + length])[orders] for k in starts])
    turns = 2 * np.pi * revolutions * (length - 1) / length
    speeds = np.array([turns / (when[k + length - 1] - when[k]) for k in starts])
    return Orders(speeds, orders / revolutions, found, FLAT_TOP / revolutions)


def _one_way(speed, what):
    """Magnitudes of a speed. @raises InputError if it is zero anywhere, or changes its sign"""
    if not (np.all(speed > 0) or np.all(speed < 0)):
        raise InputError(f"{what}: orders need a speed that is never zero and keeps its sign; --span A:B takes the "
                         "time in which it does")
    return np.abs(speed)
