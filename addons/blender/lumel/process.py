# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the program `lumel` beside Blender."""

import json
import pathlib
import queue
import re
import shutil
import signal
import subprocess
import threading
import time

OLDEST = (0, 1)  # first version whose `lumel bake` has --progress json and reads EXT_lights_area
STOPPED = 130  # exit code of a bake that SIGINT has stopped
PATIENCE = 20.0  # seconds from SIGINT to the end of a process that does not obey it


class ProgramError(Exception):
    """A failure, as a sentence for the user."""


def find_program(path):
    """The program at `path`, or the one of the search path if that is empty. Raises ProgramError."""
    found = shutil.which(str(pathlib.Path(path).expanduser())) if path else shutil.which('lumel')
    if not found:
        where = f'at {path}' if path else 'on the search path'
        raise ProgramError(f'There is no program lumel {where}; set its path in the preferences of the add-on')
    return found


def check_program(program):
    """Raises ProgramError unless the program runs and is new enough."""
    try:
        said = subprocess.run([program, '--version'], capture_output=True, text=True, timeout=60).stdout
    except (OSError, subprocess.SubprocessError) as error:
        raise ProgramError(f'{program} does not run: {error}') from error
    version = re.search(r'lumel (\d+)\.(\d+)', said)
    if not version or tuple(map(int, version.groups())) < OLDEST:
        oldest = '.'.join(map(str, OLDEST))
        raise ProgramError(f'{program} is not lumel {oldest} or newer; build or install a newer one')


class Bake:
    """A bake in a process of its own. Call poll() until it returns False."""

    def __init__(self, command):
        self.progress = {}  # the last line of --progress json: stage, fraction, shots, error, seconds
        self.messages = []  # warnings and the error of the program
        self.begin = time.monotonic()
        self._stop_time = None
        self._lines = queue.Queue()
        try:
            self._process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                             stderr=subprocess.PIPE, text=True, encoding='utf-8', errors='replace')
        except OSError as error:
            raise ProgramError(f'{command[0]} does not start: {error}') from error
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self):
        for line in self._process.stderr:
            self._lines.put(line.strip())

    def poll(self):
        """Reads what the process has printed. Returns False once it has ended."""
        ended = self._process.poll() is not None
        if ended:
            self._reader.join()
        while not self._lines.empty():
            self._take(self._lines.get())
        if not ended and self._stop_time and time.monotonic() - self._stop_time > PATIENCE:
            self._process.kill()
        return not ended

    def _take(self, line):
        if line.startswith('{'):
            try:
                self.progress = json.loads(line)
            except ValueError:
                pass
        elif line:
            self.messages.append(re.sub(r'^(warning|error): ', '', line))

    def stop(self):
        """Asks the process to end with the light so far."""
        if self._process.poll() is None and not self._stop_time:
            self._stop_time = time.monotonic()
            self._process.send_signal(signal.SIGINT)

    def wait(self, seconds):
        """Waits for the end of the process, but no longer than this."""
        try:
            self._process.wait(seconds)
        except subprocess.TimeoutExpired:
            pass

    def seconds(self):
        return time.monotonic() - self.begin

    @property
    def exit_code(self):
        return self._process.returncode

    def __str__(self):
        progress = self.progress
        if not progress:
            return 'Starting'
        text = f"{progress['stage'].capitalize()} {100 * progress['fraction']:.0f} %"
        if 'error' in progress:
            text += f", error {100 * progress['error']:.1f} %"
        return text

    def seconds_left(self):
        """Estimate for the present stage; None before there is one."""
        fraction, seconds = self.progress.get('fraction', 0), self.progress.get('seconds', 0)
        return seconds * (1 - fraction) / fraction if fraction > 0.05 and seconds > 1 else None
