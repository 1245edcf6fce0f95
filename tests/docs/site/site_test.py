"""The site of scripts/docs, with the Python reference, as a reader meets it in Chromium: its search finds programs, no link is dead, pages fit.

FOLK_SITE: the folder of the built site; FOLK_SITE_PICTURES: where to put pictures of pages, for the eye.
"""

import functools
import http.server
import os
import re
import threading
import unittest
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urljoin, urlsplit

from selenium import webdriver
from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import WebDriverWait

SITE = Path(os.environ.get("FOLK_SITE", Path(__file__).resolve().parents[3] / "build" / "docs" / "html"))
PAGES = ("index", "README", "gallery", "docs/ipd-tournament", "docs/sce-check", "docs/sct", "docs/performance",
         "cpp/analysis-tournament", "py/tournaments", "py/mpe", "notebooks/tournament", "notebooks/particle_world")


class Links(HTMLParser):
    """What a page links to, and where in it one can link to."""

    def __init__(self, text):
        super().__init__()
        self.targets, self.anchors = [], {""}
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        self.anchors |= {found[key] for key in ("id", "name") if found.get(key)}
        self.targets += [found[key] for key in ("href", "src") if found.get(key)]


class Handler(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


class Files(unittest.TestCase):
    def test_no_link_is_dead(self):
        pages = {path: Links(path.read_text(encoding="utf-8")) for path in SITE.rglob("*.html")}
        self.assertGreater(len(pages), 40)
        dead = []
        for page, links in pages.items():
            for target in links.targets:
                split = urlsplit(target)
                if split.scheme or split.netloc:
                    continue
                path = (page.parent / unquote(split.path)).resolve() if split.path else page
                anchor = unquote(split.fragment)
                if not path.exists() or (path in pages and anchor not in pages[path].anchors):
                    dead.append(f"{page.relative_to(SITE)}: {target}")
        self.assertEqual(dead, [])


class Reader(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        handler = functools.partial(Handler, directory=str(SITE))
        cls.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)
        threading.Thread(target=cls.server.serve_forever, daemon=True).start()
        options = webdriver.ChromeOptions()
        for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"):
            options.add_argument(argument)
        options.binary_location = "/usr/bin/chromium"
        cls.browser = webdriver.Chrome(options=options)

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()
        cls.server.shutdown()
        cls.server.server_close()

    def open(self, page):
        self.browser.get(urljoin(f"http://127.0.0.1:{self.server.server_address[1]}/", page))

    def test_search_finds_a_program(self):
        for words, page in (("sce-check", "docs/sce-check.html"), ("play_tournament", "cpp/analysis-tournament.html"),
                            ("behaviour_scores", "py/tournaments.html"), ("Poacher", "notebooks/tournament.html")):
            self.open(f"search.html?q={words}")
            WebDriverWait(self.browser, 20).until(
                lambda browser: browser.find_elements(By.CSS_SELECTOR, "#search-results li a"))
            found = [link.get_attribute("href") for link in
                     self.browser.find_elements(By.CSS_SELECTOR, "#search-results li a")]
            self.assertTrue(any(page in link for link in found[:5]), (words, found[:8]))

    def test_pages_fit(self):
        pictures = os.environ.get("FOLK_SITE_PICTURES")
        for width in (400, 1400):
            self.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                         {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False})
            for page in PAGES:
                with self.subTest(page=page, width=width):
                    self.open(f"{page}.html")
                    wide = self.browser.execute_script("return document.documentElement.scrollWidth")
                    self.assertLessEqual(wide, width)
                    if pictures:
                        name = re.sub(r"\W", "_", page)
                        self.browser.save_screenshot(str(Path(pictures) / f"{name}_{width}.png"))


if __name__ == "__main__":
    unittest.main()
