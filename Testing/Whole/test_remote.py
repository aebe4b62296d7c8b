"""Clouds behind addresses, in every weather: the points of the local file, or an error."""

import concurrent.futures
import json
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import unittest

from documents import STADIUM
from pictures import read_png
from tool import SLOWNESS, TOOL, WORK, ToolTest, pointfront

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "Support"))

# pylint: disable=wrong-import-position
from far_server import FarServer, asked_again
from far_weather import TOKEN
from signature_v4 import KEY, KEY_ID
from slow_line import SlowLine

HERE = "127.0.0.1"
SECRET = "sig=VERY-SECRET"
SHARED = WORK / "shared"
HANGS = 300 * SLOWNESS  # seconds, which no run takes that ends at all


def environment(**more):
    clean = {name: value for name, value in os.environ.items()
             if not name.startswith(("AWS_", "POINTFRONT_HTTP", "POINTFRONT_REMOTE")) and
             "proxy" not in name.lower()}
    return {**clean, "HOME": "/nonexistent", "POINTFRONT_CACHE": "off", **more}


def setUpModule():  # pylint: disable=invalid-name
    """The store of all tests and its points are made once."""
    shutil.rmtree(SHARED, ignore_errors=True)
    SHARED.mkdir(parents=True)
    unittest.addModuleCleanup(shutil.rmtree, SHARED, ignore_errors=True)
    for command in (("build", STADIUM, "-o", SHARED / "cloud.pfront"),
                    ("export", SHARED / "cloud.pfront", "-o", SHARED / "points.csv")):
        made = pointfront(*command)
        if made.status != 0:
            raise AssertionError(made)


class RemoteTest(ToolTest):
    def setUp(self):
        super().setUp()
        self.store = self.folder / "cloud.pfront"
        shutil.copyfile(SHARED / "cloud.pfront", self.store)
        self.expected = (SHARED / "points.csv").read_bytes()
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
        """An error that says why, without secrets; and nothing is written."""
        out = self.folder / f"no-{weather}-{name}.csv"
        outcome = self.refuse(1, "export", f"{self.address(weather, name)}?{SECRET}", "-o", out,
                              environment=environment(**more), limit=HANGS)
        for word in words:
            self.assertIn(word, outcome.err, weather)
        self.assertNotIn("VERY-SECRET", outcome.err)
        self.assertFalse(out.exists(), weather)


class GoodServers(RemoteTest):
    def test_the_points_are_those_of_the_file(self):
        for weather in ("", "weak", "nameless", "hop"):
            with self.subTest(weather):
                self.assert_served(weather)

    def test_an_export_says_what_came_from_servers(self):
        facts = self.folder / "facts.json"
        for cloud, far in ((self.store, False), (self.address(""), True)):
            out = self.folder / "out.las"
            self.succeed("export", cloud, "-o", out, "--force", "--stats", facts,
                         environment=environment())
            said = json.loads(facts.read_text())
            self.assertEqual(said["points_written"], len(self.expected.splitlines()) - 1)
            self.assertEqual(said["bytes_written"], out.stat().st_size)
            self.assertEqual(said["requests"] > 0, far)
            self.assertEqual(said["bytes_fetched"] > said["bytes_written"] / 10, far)
            self.assertEqual([said[key] for key in ("retries", "cache_hits", "cache_bytes")],
                             [0, 0, 0])
        for path in (out, self.store):  # neither a target nor a source
            self.refuse(1, "export", self.store, "-o", out, "--force", "--stats", path)

    def test_info_and_render(self):
        address = self.address("")
        facts = self.succeed("info", address, "--json", environment=environment()).json
        near = self.succeed("info", self.store, "--json").json
        self.assertEqual(facts["points"], near["points"])
        self.assertEqual(facts["bounds"], near["bounds"])
        self.assertNotIn("traffic", near)
        self.assertEqual(set(facts["traffic"]), {"requests", "bytes_fetched", "retries",
                                                 "cache_hits", "cache_bytes"})
        self.assertGreater(facts["traffic"]["requests"], 0)
        self.assertGreater(facts["traffic"]["bytes_fetched"], 1000)
        text = self.succeed("info", address, environment=environment()).out
        self.assertRegex(text, r"\n  traffic +[1-9][0-9]* requests?, [0-9.]+ [KM]iB fetched")
        self.assertNotIn("traffic", self.succeed("info", self.store).out)
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

    def test_an_environment_that_says_nothing_sound(self):
        refused = self.refuse(1, "info", self.address(""),
                              environment=environment(POINTFRONT_FAR="X: SECRET-LINE"))
        self.assertIn("POINTFRONT_FAR", refused.err)
        self.assertNotIn("SECRET-LINE", refused.err)

    def test_headers_that_are_for_nobody(self):
        settings = self.folder / "headers"
        for text, line in ((f"Authorization: Bearer {TOKEN}\n", 1),
                           (f"# for all\n\nX: {TOKEN}\n[{self.origin()}]\nX: Y\n", 3)):
            settings.write_text(text)
            said = self.refuse(1, "info", self.address(""), environment=environment(
                POINTFRONT_HTTP_HEADERS=str(settings))).err
            self.assertIn(f"POINTFRONT_HTTP_HEADERS: line {line} of '{settings}'", said)
            self.assertRegex(said, rf"\A(?!.*{TOKEN}).*write \[{self.origin()}\]")
        settings.write_text("# nothing\n")
        self.assert_served("", POINTFRONT_HTTP_HEADERS=str(settings))

    def test_a_collection_holds_no_secrets(self):
        """It has the public forms of addresses, which only one process knows how to open."""
        city = self.folder / "e.pfcollection"
        secret = f"{self.address('')}?{SECRET}"
        behind = self.address("").replace("//", "//me:VERY-SECRET@")
        create = ("collection", "create", city)
        for words in ((*create, secret), (*create, self.store, behind),
                      (*create, f"{secret}#far:timeout=99")):
            refused = self.refuse(1, *words, environment=environment())
            self.assertRegex(refused.err, r"(?s)\A(?!.*VERY-SECRET).*POINTFRONT_HTTP_HEADERS")
            self.assertFalse(city.exists())
        self.assertEqual(self.server.requests, [])
        self.succeed(*create, self.address(""), environment=environment())
        before = city.read_bytes()
        for words in (("add", city, secret, "--name", "other"), ("replace", city, secret)):
            refused = self.refuse(1, "collection", *words, environment=environment())
            self.assertIn("POINTFRONT_HTTP_HEADERS", refused.err)
        self.assertEqual(city.read_bytes(), before)
        self.assertEqual(sorted(self.points(city, environment=environment()).splitlines()),
                         sorted(self.expected.splitlines()))

    def test_a_query_is_no_part_of_what_is_said(self):
        outcome = self.succeed("info", f"{self.address('')}?{SECRET}", "--json",
                               environment=environment())
        self.assertNotIn("VERY-SECRET", outcome.out + outcome.err)


class Cache(RemoteTest):
    """Bytes that were fetched once lie on the disk."""

    def setUp(self):
        super().setUp()
        self.cache = self.folder / "cache"
        self.with_cache = environment(POINTFRONT_CACHE=str(self.cache))

    def draw(self, cloud, *options, **more):
        picture, facts = self.folder / "cached.png", self.folder / "cached.json"
        self.succeed("render", cloud, "-o", picture, "--size", "320x240", "--backend", "software",
                     "--stats", facts, *options, environment={**self.with_cache, **more})
        return read_png(picture), json.loads(facts.read_text())

    def settled(self, cloud):
        """Facts of the picture with the fewest requests, of three: a busy machine may ask for a
        node that the picture turns out not to need, and then the cache has that, too."""
        return min((self.draw(cloud)[1] for _ in range(3)), key=lambda facts: facts["requests"])

    def test_a_size_that_is_none_is_refused(self):
        for size in ("abc", "5X", "-1", "1Gb2", "nan"):
            for words in (("info", self.address("")), ("cache", "info")):
                told = {**self.with_cache, "POINTFRONT_CACHE_SIZE": size}
                self.assertIn(f"POINTFRONT_CACHE_SIZE: '{size}' is no size",
                              self.refuse(1, *words, environment=told).err)
        self.assertFalse(self.cache.exists())
        for size, options in (("5M", ()), ("abc", ("--cache-size", "1G"))):
            self.draw(self.address(""), *options, POINTFRONT_CACHE_SIZE=size)
            shutil.rmtree(self.cache / "segments")
        self.draw(self.address(""), POINTFRONT_CACHE_SIZE="0")
        self.assertFalse((self.cache / "segments").exists())

    def test_the_second_picture_asks_only_whether_the_file_changed(self):
        near, facts = self.draw(self.store)
        self.assertEqual((facts["requests"], facts["cache_hits"]), (0, 0))
        first, facts = self.draw(self.address(""))
        self.assertGreater(facts["requests"], 0)
        self.assertGreater(facts["bytes_fetched"], 10000)
        fetched, before = facts["bytes_fetched"], list(self.server.requests)
        second, facts = self.draw(f"{self.address('')}?X-Amz-Signature=another")
        self.assertLessEqual(asked_again(before, self.server.requests[len(before):]), 4096)
        self.assertLess(facts["bytes_fetched"], fetched / 4)
        self.assertGreater(facts["cache_hits"], 0)
        self.assertGreater(facts["cache_bytes"], 10000)
        facts = self.settled(f"{self.address('')}?X-Amz-Signature=another")
        self.assertLessEqual(facts["requests"], 2, facts)  # head and tail, at once
        text = self.succeed("info", self.address(""), environment=self.with_cache).out
        self.assertRegex(text, r"\n  traffic .*, [1-9][0-9.]* [KM]iB from the cache")
        self.assertTrue((near == first).all() and (near == second).all())

    def test_a_file_that_its_server_promises_is_not_asked_about(self):
        address = self.address("immutable")
        first, again = self.draw(address)[0], []
        for _ in range(3):  # the end of a program may cut off an answer that nothing waits for
            before = list(self.server.requests)
            second, facts = self.draw(address)
            after = self.server.requests[len(before):]
            again.append(asked_again(before, after))
            self.assertEqual((facts["requests"], (first == second).all()), (len(after), True))
        self.assertEqual(min(again), 0)
        self.assertEqual(self.settled(address)["requests"], 0)
        self.assertEqual(self.points(address, environment=self.with_cache), self.expected)

    def test_a_promise_that_is_not_kept_is_told_once(self):
        address = self.address("immutable")
        self.draw(address, "--frames", "1")
        self.succeed("build", STADIUM, "-o", self.store, "--force", "--node-points", "5000")
        out = self.folder / "none.csv"
        said = self.refuse(1, "export", address, "-o", out, environment=self.with_cache).err
        self.assertIn("has changed on its server", said)
        self.assertFalse(out.exists())
        self.assertEqual(self.points(address, environment=self.with_cache),
                         self.points(self.store))

    def test_offline(self):
        self.refuse(1, "info", self.address(""), "--offline", environment=self.with_cache)
        online, _ = self.draw(self.address(""))
        self.server.requests.clear()
        offline, facts = self.draw(self.address(""), "--offline")
        self.assertEqual(facts["requests"], 0)
        self.assertEqual(self.server.requests, [])
        self.assertTrue((online == offline).all())
        words = ("info", self.address("weak"), "--offline")
        self.assertIn("offline", self.refuse(1, *words, environment=self.with_cache).err)

    def test_a_file_that_was_replaced_is_fetched_again(self):
        self.points(self.address(""), environment=self.with_cache)
        self.succeed("build", STADIUM, "-o", self.store, "--force", "--node-points", "5000")
        self.assertEqual(sorted(self.points(self.address(""),
                                            environment=self.with_cache).splitlines()),
                         sorted(self.expected.splitlines()))
        self.assertEqual(self.points(self.address(""), environment=self.with_cache),
                         self.points(self.store))

    def test_damage_is_seen_and_nothing_secret_lies_there(self):
        address = f"{self.address('')}?{SECRET}&token=VERY-SECRET"
        self.points(address, environment=self.with_cache)
        files = [path for path in self.cache.rglob("*") if path.is_file()]
        self.assertTrue(files)
        self.assertEqual(self.cache.stat().st_mode & 0o77, 0)
        for path in files:
            self.assertNotIn("VERY-SECRET", str(path))
            self.assertNotIn(b"VERY-SECRET", path.read_bytes())
        for path in self.cache.glob("segments/*/*"):
            content = bytearray(path.read_bytes())
            content[len(content) // 2] ^= 1
            path.write_bytes(content)
        self.assertEqual(self.points(address, environment=self.with_cache), self.expected)

    def test_the_command(self):
        self.points(self.address(""), environment=self.with_cache)
        facts = self.succeed("cache", "info", "--json", environment=self.with_cache).json
        self.assertEqual(facts["folder"], str(self.cache))
        self.assertGreater(facts["bytes"], 10000)
        self.assertTrue(self.succeed("cache", "verify", "--json",
                                     environment=self.with_cache).json["ok"])
        segment = next(self.cache.glob("segments/*/*"))
        segment.write_bytes(segment.read_bytes()[:-1])
        refused = self.refuse(1, "cache", "verify", environment=self.with_cache)
        self.assertIn("damaged", refused.err)
        self.succeed("cache", "clear", environment=self.with_cache)
        facts = self.succeed("cache", "info", "--json", environment=self.with_cache).json
        self.assertEqual(facts["bytes"], 0)
        self.refuse(1, "cache", "info", environment=environment())
        self.refuse(2, "info", self.address(""), "--cache-size", "much")
        self.points(self.address(""), environment=self.with_cache)
        outcome = self.succeed("info", self.address(""), "--cache-size", "0", "--json",
                               environment=self.with_cache)
        self.assertEqual(outcome.json["points"], len(self.expected.splitlines()) - 1)


class BadWeather(RemoteTest):
    def test_faults_that_pass(self):
        for weather in ("reset", "storm", "busy", "two", "ranges_ignored"):
            with self.subTest(weather):
                self.assert_served(weather)

    def test_faults_that_stay(self):
        """Answers that say what is wrong: the limit of time is the tool's own, a minute."""
        for case in (
                ("forbidden", "403"), ("long", "wrongly"), ("elsewhere", "wrongly"),
                ("replaced", "changed"), ("replaced_deaf", "changed"),
                ("replaced_dated", "changed"), ("replaced_longer", "changed"),
                ("expired", "403"), ("circle", "redirected"), ("to_file", "redirected"),
                ("gzipped", "compressed"), ("lying", "Content-Range"), ("huge", "wrongly")):
            self.assert_refused(*case)
        self.assert_refused("", "404", name="missing.pfront")

    def test_bodies_without_end(self):
        """Bodies that go on keep the server busy: nothing else is asked of it."""
        for case in (("endless", "wrongly"), ("endless_whole", "64 MiB"), ("headers", "wrongly")):
            self.assert_refused(*case)

    def test_silence_that_stays(self):
        """The limit of time ends these: all at once, since they wait. A busy machine answers
        within the longer limit, where the test asks what the answer was."""
        seconds = {"storms": 12, "tomorrow": 12, "trickle": 12, "resets": 3, "stalls": 3,
                   "short": 3}
        words = {"storms": "503", "tomorrow": "503", "trickle": "1 KiB a second"}
        with concurrent.futures.ThreadPoolExecutor(len(seconds)) as several:
            list(several.map(
                lambda weather: self.assert_refused(
                    weather, "at the moment", words.get(weather, ""),
                    POINTFRONT_REMOTE_TIMEOUT=str(seconds[weather])), seconds))

    def test_a_slow_line_is_waited_for_while_bytes_come(self):
        """The time limit is one of silence: one body takes longer than two limits. A busy machine
        is silent for a second, not for five."""
        seconds, limit = 6, 5  # head and tail are asked for at once: twice the file
        bits = 8 * self.store.stat().st_size / seconds
        with SlowLine(self.server.port, 0.02, bits) as line:
            out = self.folder / "slow.csv"
            outcome = self.succeed(
                "export", f"http://{HERE}:{line.port}/~ranges_ignored/cloud.pfront", "-o", out,
                environment=environment(POINTFRONT_REMOTE_TIMEOUT=str(limit)))
        self.assertEqual(out.read_bytes(), self.expected)
        self.assertGreater(outcome.seconds, 2 * limit)

    def test_a_signal_ends_the_wait_for_a_silent_server(self):
        out = self.folder / "never.csv"
        with socket.create_server((HERE, 0)) as silent:
            silent.settimeout(HANGS)
            port = silent.getsockname()[1]
            with subprocess.Popen([TOOL, "export", f"http://{HERE}:{port}/a.pfront", "-o", out],
                                  env=environment(), stderr=subprocess.PIPE) as tool:
                with silent.accept()[0] as connection:
                    connection.recv(65536)
                    tool.send_signal(signal.SIGINT)
                    status = tool.wait(HANGS)
        self.assertEqual(status, 130)  # after a minute of silence it would be 1
        self.assertFalse(out.exists())

    def test_a_query_takes_round_trips_by_groups_of_nodes(self):
        small = self.folder / "small.pfront"
        self.succeed("build", STADIUM, "-o", small, "--node-points", "500")
        nodes = self.succeed("info", small, "--json").json["nodes"]
        expected = self.points(small)
        self.server.requests.clear()
        self.assertEqual(self.points(self.address("", "small.pfront"), environment=environment()),
                         expected)
        self.assertLess(len(self.server.requests), nodes / 10)

    def test_a_certificate_that_nobody_vouches_for(self):
        own = self.folder / "own.pem"
        subprocess.run(["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "2",
                        "-subj", "/CN=localhost", "-addext",
                        f"subjectAltName=IP:{HERE},DNS:localhost", "-keyout", own, "-out",
                        self.folder / "public.pem"], check=True, capture_output=True)
        own.write_text(own.read_text() + (self.folder / "public.pem").read_text())
        with FarServer(self.folder, str(own)) as server:
            address = f"https://{HERE}:{server.port}/cloud.pfront"
            refused = self.refuse(1, "info", f"{address}?{SECRET}", environment=environment())
            self.assertIn("certificate", refused.err)
            self.assertNotIn("VERY-SECRET", refused.err)
            trusting = environment(SSL_CERT_FILE=str(self.folder / "public.pem"), CURL_CA_BUNDLE="")
            self.assertEqual(self.points(address, environment=trusting), self.expected)

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
