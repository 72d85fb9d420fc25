"""A headless browser that shows pages of bielle-view: Debian's chromium, controlled by selenium."""

import importlib.util
import io
import os
import shutil
import time
import unittest

import numpy as np

WHY_NOT = next((reason for missing, reason in (
    (not shutil.which("chromium"), "chromium is not installed (Debian package chromium; tools/install --with-checks)"),
    (not shutil.which("chromedriver"), "chromedriver is not installed (Debian package chromium-driver)"),
    (importlib.util.find_spec("selenium") is None, "selenium is not installed (Debian package python3-selenium)"),
    (not os.path.isfile("/usr/share/javascript/three/three.min.js"), "three.js is not installed (Debian package libjs-three)")) if missing), "")


class Pages(unittest.TestCase):
    """Base class with one browser for all tests; no page may write an error to the console."""

    @classmethod
    def setUpClass(cls):
        from selenium import webdriver
        from selenium.webdriver.chrome.options import Options
        from selenium.webdriver.chrome.service import Service
        options = Options()
        options.binary_location = shutil.which("chromium")
        for word in ("--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-gpu-compositing", "--disable-dev-shm-usage",
                     "--window-size=1000,700"):
            options.add_argument(word)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        cls.browser = webdriver.Chrome(options=options, service=Service(shutil.which("chromedriver")))
        cls.browser.set_script_timeout(120)

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()

    def open(self, address):
        """Opens a page and waits until it is ready."""
        self.browser.get_log("browser")
        self.browser.get(address if "://" in address else "file://" + address)
        end = time.monotonic() + 120
        while not self.run_script("return Boolean(window.bielle && window.bielle.ready)"):
            said = self.run_script("const e = document.getElementById('waiting'); return e ? e.textContent : ''")
            self.assertFalse(said.startswith("This page cannot"), said)
            self.assertLess(time.monotonic(), end, "the page was not ready in time")
            time.sleep(0.05)

    def run_script(self, script, *arguments):
        return self.browser.execute_script(script, *arguments)

    def settled(self):
        """Waits until the picture is drawn with all changes."""
        self.browser.execute_async_script("const done = arguments[0]; requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(done)));")

    def picture(self):
        """Returns the page as an array (h,w,3)."""
        from PIL import Image
        self.settled()
        return np.asarray(Image.open(io.BytesIO(self.browser.get_screenshot_as_png())).convert("RGB")).astype(int)

    def drawn(self):
        """Returns the number of drawn pixels in the canvas of the scene, without the grid."""
        self.run_script("bielle.settings.grid = false; bielle.changed()")
        self.settled()
        return self.run_script("""bielle.render(); const c = document.getElementById("scene"), o = document.createElement("canvas"); o.width = c.width; o.height = c.height;
            const p = o.getContext("2d"); p.drawImage(c, 0, 0); const d = p.getImageData(0, 0, c.width, c.height).data; let n = 0;
            for (let k = 3; k < d.length; k += 4) if (d[k] > 0) n++; return n;""")

    def no_errors(self):
        told = [entry["message"] for entry in self.browser.get_log("browser") if entry["level"] == "SEVERE"]
        self.assertEqual(told, [])
