"""Chromium without a window, for tests of pages. Requires Chromium, its driver and Selenium."""

import json
import pathlib
import tempfile
import unittest

from selenium import webdriver
from selenium.webdriver.chrome.service import Service


class InChromium(unittest.TestCase):
    """Tests with a browser, `self.chromium`, whose console and requests are logged, and a folder for files."""

    @classmethod
    def setUpClass(cls):
        options = webdriver.ChromeOptions()
        for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"):
            options.add_argument(argument)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        cls.chromium = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
        cls.addClassCleanup(cls.chromium.quit)
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))

    def requests(self):
        """Returns the addresses that were requested since the last call."""
        messages = [json.loads(entry["message"])["message"] for entry in self.chromium.get_log("performance")]
        return [message["params"]["request"]["url"] for message in messages
                if message["method"] == "Network.requestWillBeSent"]
