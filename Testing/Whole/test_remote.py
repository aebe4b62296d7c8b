"""Clouds behind addresses, in every weather: the points of the local file, or an error."""

import concurrent.futures
import os
import pathlib
import sys
import unittest

from documents import STADIUM
from pictures import read_png
from tool import SLOWNESS, ToolTest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "Support"))

# pylint: disable=wrong-import-position
from far_server import FarServer
from far_weather import TOKEN
from signature_v4 import KEY, KEY_ID

HERE = "127.0.0.1"
SECRET = "sig=VERY-SECRET"


def environment(**more):
    clean = {name: value for name, value in os.environ.items()
             if not name.startswith(("AWS_", "POINTFRONT_HTTP", "POINTFRONT_REMOTE")) and
             "proxy" not in name.lower()}
    return {**clean, "HOME": "/nonexistent", **more}


class RemoteTest(ToolTest):
    def setUp(self):
        super().setUp()
        self.store = self.build(STADIUM)
        self.expected = self.points(self.store)
        self.server = FarServer(self.folder)
        self.server.__enter__()
        self.addCleanup(self.server.__exit__)

    def points(self, cloud, **options):
        out = self.folder / "points.csv"
        self.succeed("export", cloud, "-o", out, "--force", **options)
        return out.read_bytes()

    def origin(self):
        return f"http://{HERE}:{self.server.port}"

    def address(self, weather, name="cloud.pfront"):
        below = f"~{weather}/" if weather else ""
        return f"{self.origin()}/{below}{name}"

    def assert_served(self, mode, **more):
        self.assertEqual(self.points(self.address(mode), environment=environment(**more)),
                         self.expected, mode)

    def assert_refused(self, weather, *words, name="cloud.pfront", **more):
        """An error that says why, in time, without secrets; and nothing is written."""
        out = self.folder / f"no-{weather}-{name}.csv"
        outcome = self.refuse(1, "export", f"{self.address(weather, name)}?{SECRET}", "-o", out,
                              environment=environment(POINTFRONT_REMOTE_TIMEOUT="3", **more))
        self.assertLess(outcome.seconds, 30 * SLOWNESS, weather)
        for word in words:
            self.assertIn(word, outcome.err, weather)
        self.assertNotIn("VERY-SECRET", outcome.err)
        self.assertFalse(out.exists(), weather)


class GoodServers(RemoteTest):
    def test_the_points_are_those_of_the_file(self):
        for weather in ("", "weak", "nameless", "hop"):
            with self.subTest(weather):
                self.assert_served(weather)

    def test_info_and_render(self):
        address = self.address("")
        facts = self.succeed("info", address, "--json", environment=environment()).json
        near = self.succeed("info", self.store, "--json").json
        self.assertEqual(facts["points"], near["points"])
        self.assertEqual(facts["bounds"], near["bounds"])
        pictures = []
        for cloud in (address, self.store):
            out = self.folder / "picture.png"
            self.succeed("render", cloud, "-o", out, "--size", "320x240", "--backend", "software",
                         environment=environment())
            pictures.append(read_png(out))
        self.assertTrue((pictures[0] == pictures[1]).all())

    def test_a_store_is_built_from_an_address(self):
        store = self.folder / "again.pfront"
        self.succeed("build", self.address(""), "-o", store, environment=environment())
        self.assertEqual(sorted(self.points(store).splitlines()),
                         sorted(self.expected.splitlines()))

    def test_a_store_that_lies_in_a_bucket(self):
        keys = {"AWS_ACCESS_KEY_ID": KEY_ID, "AWS_SECRET_ACCESS_KEY": KEY,
                "AWS_REGION": "eu-central-1",
                "AWS_ENDPOINT_URL": self.origin()}
        cloud = "s3://~s3/cloud.pfront"
        self.assertEqual(self.points(cloud, environment=environment(**keys)), self.expected,
                         self.server.faults)
        refused = self.refuse(1, "info", cloud, environment=environment(
            **{**keys, "AWS_SECRET_ACCESS_KEY": "another-secret"}))
        self.assertIn("403", refused.err)
        self.assertNotIn("another-secret", refused.err)
        # A public bucket: no key, no signature.
        self.server.requests.clear()
        public = environment(AWS_ENDPOINT_URL=self.origin())
        self.assertEqual(self.points("s3://~weak/cloud.pfront", environment=public), self.expected)
        self.assertFalse([seen for seen in self.server.requests if seen["authorization"]])

    def test_a_token_goes_to_its_server_alone(self):
        settings = self.folder / "headers"
        settings.write_text(f"[{self.origin()}]\n"
                            f"Authorization: Bearer {TOKEN}\n")
        self.assert_served("bearer", POINTFRONT_HTTP_HEADERS=str(settings))
        self.server.requests.clear()
        self.assert_served("bearer_hop", POINTFRONT_HTTP_HEADERS=str(settings))
        away = [seen for seen in self.server.requests if seen["host"].startswith("localhost")]
        self.assertTrue(away)
        self.assertFalse([seen for seen in away if seen["authorization"]])

    def test_a_query_is_no_part_of_what_is_said(self):
        outcome = self.succeed("info", f"{self.address('')}?{SECRET}", "--json",
                               environment=environment())
        self.assertNotIn("VERY-SECRET", outcome.out + outcome.err)


class BadWeather(RemoteTest):
    def test_faults_that_pass(self):
        for weather in ("reset", "storm", "busy", "two", "ranges_ignored"):
            with self.subTest(weather):
                self.assert_served(weather)

    def test_faults_that_stay(self):
        lasting = (
                ("forbidden", "403"), ("storms", "503"), ("tomorrow", "503"), ("resets",),
                ("stalls",), ("short",), ("long",), ("elsewhere", "wrongly"),
                ("replaced", "changed"), ("replaced_deaf", "changed"),
                ("replaced_dated", "changed"), ("replaced_longer", "changed"),
                ("expired", "403"), ("circle", "redirected"), ("to_file", "redirected"),
                ("gzipped", "compressed"), ("endless",), ("endless_whole",), ("lying",), ("huge",),
                ("headers",))
        with concurrent.futures.ThreadPoolExecutor(8) as several:  # they wait most of the time
            list(several.map(lambda case: self.assert_refused(*case), lasting))
        self.assert_refused("", "404", name="missing.pfront")

    def test_no_server_and_no_name(self):
        for host in (f"{HERE}:9", "no.such.host.invalid"):
            self.refuse(1, "info", f"http://{host}/a.pfront",
                        environment=environment(POINTFRONT_REMOTE_TIMEOUT="3"))

    def test_this_network_when_told_not_to(self):
        for weather in ("", "to_private"):
            self.assert_refused(weather, "cannot be reached", POINTFRONT_REMOTE_PRIVATE="refuse")

    def test_a_scheme_that_nobody_knows(self):
        refused = self.refuse(1, "info", "gopher://host/cloud.pfront")
        self.assertIn("https", refused.err)

    def test_a_file_that_is_no_cloud(self):
        (self.folder / "words.txt").write_text("no points here\n" * 1000)
        (self.folder / "empty").write_bytes(b"")
        for name in ("words.txt", "empty"):
            with self.subTest(name):
                self.assert_refused("", name=name)


if __name__ == "__main__":
    unittest.main()
