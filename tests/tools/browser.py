"""Headless Chromium, controlled by its DevTools protocol: JSON over two pipes."""

import collections
import fcntl
import itertools
import json
import os
import select
import signal
import subprocess
import tempfile
import time

CHROMIUM = os.environ.get("CHROMIUM", "chromium")
PATIENCE = 60  # seconds for any answer
OPTIONS = ("--headless", "--remote-debugging-pipe", "--disable-gpu", "--disable-dev-shm-usage",
           "--no-first-run", "--no-default-browser-check", "--disable-background-networking",
           "--disable-extensions", "--hide-scrollbars", "--force-device-scale-factor=1")


class Failure(Exception):
    """An error of the browser or the page."""


def pipe():
    """Returns a pipe whose descriptors are above those passed to the browser."""
    ends = os.pipe()
    far = [fcntl.fcntl(end, fcntl.F_DUPFD_CLOEXEC, 10) for end in ends]
    for end in ends:
        os.close(end)
    return far


class Browser:
    """One page in a separate browser with a temporary profile."""

    def __init__(self, width=1280, height=900):
        self.profile = tempfile.TemporaryDirectory(prefix="overturn-test-",
                                                   ignore_cleanup_errors=True)
        self.events = collections.defaultdict(list)
        self.numbers = itertools.count(1)
        self.unread = b""
        its_input, self.requests = pipe()
        self.answers, its_output = pipe()
        # It reads from 3 and writes to 4. As root it runs without a sandbox.
        self.process = subprocess.Popen(
            ["bash", "-c", 'exec "${@:3}" 3<&"$1" 4>&"$2"', "browser", str(its_input),
             str(its_output), CHROMIUM, *OPTIONS, *(["--no-sandbox"] if os.geteuid() == 0 else []),
             f"--user-data-dir={self.profile.name}", f"--window-size={width},{height}"],
            pass_fds=(its_input, its_output), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL, start_new_session=True)
        os.close(its_input)
        os.close(its_output)
        self.session = None
        try:
            target = self.ask("Target.createTarget", url="about:blank")["targetId"]
            self.session = self.ask("Target.attachToTarget", targetId=target,
                                    flatten=True)["sessionId"]
            for domain in ("Page", "Runtime", "Log", "Network"):
                self.ask(f"{domain}.enable")
            self.resize(width, height)
        except BaseException:
            self.close()
            raise

    def close(self):
        """Closes the browser and ends all processes that it has started."""
        try:
            self.session = None
            self.ask("Browser.close")
            self.process.wait(10)
        except (Failure, OSError, subprocess.TimeoutExpired):
            pass
        try:
            os.killpg(self.process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        self.process.wait(PATIENCE)
        os.close(self.requests)
        os.close(self.answers)
        self.profile.cleanup()

    def ask(self, method, **parameters):
        """Returns the answer; events received before it are stored."""
        number = next(self.numbers)
        message = {"id": number, "method": method, "params": parameters}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.requests, json.dumps(message).encode() + b"\0")
        deadline = time.monotonic() + PATIENCE
        while True:
            answer = self.next_message(deadline)
            if answer.get("id") == number:
                if "error" in answer:
                    raise Failure(f"{method}: {answer['error']}")
                return answer["result"]
            self.events[answer.get("method")].append(answer.get("params"))

    def next_message(self, deadline):
        while b"\0" not in self.unread:
            ready, _, _ = select.select([self.answers], [], [], deadline - time.monotonic())
            part = os.read(self.answers, 1 << 20) if ready else b""
            if not part:
                raise Failure("the browser is silent" if not ready else "the browser has ended")
            self.unread += part
        message, _, self.unread = self.unread.partition(b"\0")
        return json.loads(message)

    def resize(self, width, height):
        self.ask("Emulation.setDeviceMetricsOverride", width=width, height=height,
                 deviceScaleFactor=1, mobile=False)

    def open(self, path):
        self.ask("Page.navigate", url=path.resolve().as_uri())
        self.wait("document.readyState === 'complete'")

    def evaluate(self, expression):
        answer = self.ask("Runtime.evaluate", expression=expression, returnByValue=True,
                          awaitPromise=True)
        if "exceptionDetails" in answer:
            raise Failure(f"{expression}: {answer['exceptionDetails']}")
        return answer["result"].get("value")

    def wait(self, expression, patience=PATIENCE):
        """Waits until the expression is true."""
        deadline = time.monotonic() + patience
        while not self.evaluate(f"Boolean({expression})"):
            if time.monotonic() > deadline:
                raise Failure(f"did not become true: {expression}")
            time.sleep(0.02)

    def move(self, x, y):
        self.ask("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y)

    def click(self, x, y):
        for kind in ("mousePressed", "mouseReleased"):
            self.ask("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)

    def tap(self, x, y):
        """Touches the screen."""
        self.ask("Input.dispatchTouchEvent", type="touchStart", touchPoints=[{"x": x, "y": y}])
        self.ask("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])

    def press(self, key, shift=False):
        for kind in ("rawKeyDown", "keyUp"):
            self.ask("Input.dispatchKeyEvent", type=kind, key=key, code=key, modifiers=8 * shift)

    def screenshot(self):
        """Returns a PNG in base64."""
        return self.ask("Page.captureScreenshot", format="png")["data"]
