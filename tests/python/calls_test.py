"""Errors, progress, interruption, threads, memory: how a call into the library behaves."""

import contextlib
import io
import os
import shutil
import signal
import subprocess
import sys
import threading
import time
import unittest

import folk
import numpy

SANITIZED = "FOLK_SANITIZED" in os.environ


def resident():
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def threads():
    return len(os.listdir("/proc/self/task"))


class Errors(unittest.TestCase):
    def test_each_has_its_class_and_one_line(self):
        for call, kind in ((lambda: folk.strategy("tit_fo_tat"), folk.UsageError),
                           (lambda: folk.tournament(noise=2), folk.UsageError),
                           (lambda: folk.tournament("@/no/such.machines"), folk.InputError),
                           (lambda: folk.read_game("/no/such.nfg"), folk.InputError),
                           (lambda: folk.match("exec:false", "all_d"), folk.EnvironmentError),
                           (lambda: folk.strategy("sct").minimised(), folk.UsageError),
                           (lambda: folk.stage_game([[1, 2]], [[1], [2]]), folk.UsageError),
                           (lambda: folk.check("gradual", "pavlov", criterion="discounted:0.5"), folk.UsageError)):
            with self.assertRaises(kind) as raised:
                call()
            self.assertIsInstance(raised.exception, folk.Error)
            self.assertNotIn("\n", str(raised.exception))

    def test_messages_are_the_programs_in_words_of_python(self):
        done = subprocess.run([os.path.join(os.environ["FOLK_BIN"], "ipd-tournament"), "--noise", "2"],
                              capture_output=True, text=True, check=False)
        with self.assertRaises(folk.UsageError) as raised:
            folk.tournament(noise=2)
        self.assertEqual(f"ipd-tournament: {raised.exception}\n", done.stderr.replace("--noise '2'", "noise='2'"))

    def test_arguments_are_called_as_they_were_given(self):
        for call, begin in ((lambda: folk.check("pavlov", "pavlov", from_=0), "from_= (or from_=settled) '0': expected"),
                            (lambda: folk.check("pavlov", "pavlov", class_="sct"), "class_=sct: no machine is in it"),
                            (lambda: folk.check("pavlov", "pavlov", epsilon_payoff=-1), "epsilon_payoff='-1': expected"),
                            (lambda: folk.evolve(individuals=3, population=4), "individuals= and population= contradict"),
                            (lambda: folk.best_reply("pavlov,all_d", memory_one=True, horizon=4, criterion="mean"),
                             "horizon= does not go with memory_one=: take finite:T"),
                            (lambda: folk.evolve(start="all_c"), "start='all_c': expected NAME=N"),
                            (lambda: folk.strategy("--noise 2"), "unknown strategy '--noise 2'")):
            with self.assertRaises(folk.UsageError) as raised:
                call()
            self.assertTrue(str(raised.exception).startswith(begin), raised.exception)


class Progress(unittest.TestCase):
    def test_is_told_and_may_end_the_work(self):
        seen = []
        folk.tournament("memory(1,2)", rounds=100, progress=seen.append)
        self.assertEqual(seen[-1], 1)

        def ends(share):
            raise RuntimeError("enough")

        with self.assertRaisesRegex(RuntimeError, "enough"):
            folk.tournament("memory(1,2)", rounds=100, progress=ends)

    def test_a_notebook_shows_a_bar(self):
        class Slow(folk.Player):
            deterministic = True

            def move(self):
                time.sleep(0.02)
                return "C"

        class Page(io.StringIO):
            """Stands for the stderr of a notebook, which is known by its module."""

        Page.__module__ = "ipykernel.iostream"
        with contextlib.redirect_stderr(Page()) as page:
            folk.tournament([Slow, "all_c", "all_d", "tit_for_tat", "pavlov"], rounds=20, progress=False)
            self.assertEqual(page.getvalue(), "")
            folk.tournament([Slow, "all_c", "all_d", "tit_for_tat", "pavlov"], rounds=20)
        drawn = page.getvalue().split("\r")
        self.assertRegex(drawn[1], r"^playing 5 strategies \[[#-]{20}\]  ?\d+ %")
        self.assertEqual((drawn[-2].strip(" "), drawn[-1]), ("", ""))  # nothing is left of it
        self.assertGreaterEqual(len(drawn[-2]), len(drawn[-3].rstrip(" ")))

    def test_interruption_ends_within_a_second(self):
        before = threads()
        for work in (lambda: folk.tournament("memory(1,2),memory(2,1)", noise=0.01, criterion="discounted:0.99"),
                     lambda: folk.complete_class("memory(4,4)").score("gradual,soft_majo", rounds=100),
                     lambda: folk.evolve("memory(1,2)", model="encounter", generations=10**9)):
            sent = []

            def interrupt():
                time.sleep(0.5)
                sent.append(time.monotonic())
                os.kill(os.getpid(), signal.SIGINT)

            thread = threading.Thread(target=interrupt)
            thread.start()
            with self.assertRaises(KeyboardInterrupt):
                work()
            self.assertLess(time.monotonic() - sent[0], 20 if SANITIZED else 1)
            thread.join()
        for _ in range(200):  # one that was joined may stand in /proc for a moment more
            if threads() == before:
                return
            time.sleep(0.01)
        self.assertEqual(threads(), before)


class Threads(unittest.TestCase):
    def test_two_at_once_get_the_same(self):
        expected = folk.tournament("memory(1,2)", rounds=100).signature
        found = []

        def work():
            for _ in range(5):
                found.append(folk.tournament("memory(1,2)", rounds=100, threads=2).signature)
                folk.match(lambda history: "D", "tit_for_tat", rounds=50)
                folk.check("pavlov", "pavlov", criterion="discounted:0.6")
                folk.evolve("all_c,all_d", rounds=10)
                env = folk.mpe.BatchEnv("simple_tag", 64)
                env.reset(seed=1)
                env.step()

        workers = [threading.Thread(target=work) for _ in range(2)]
        for worker in workers:
            worker.start()
        for worker in workers:
            worker.join()
        self.assertEqual(found, [expected] * 10)


class Arrays(unittest.TestCase):
    def test_views_are_of_the_librarys_memory(self):
        result = folk.tournament("tit_for_tat,all_d,pavlov", rounds=10)
        self.assertFalse(result.scores.flags.owndata)
        self.assertFalse(result.scores.flags.writeable)
        self.assertTrue(numpy.shares_memory(result.scores, result.behaviour_scores))
        scores = result.scores
        del result
        self.assertEqual(scores[0, 1], 9)
        many = folk.tournament("memory(1,2)", rounds=10)
        self.assertIs(many.scores, many.scores)
        laid_out = many.behaviour_scores[numpy.ix_(many.behaviours, many.behaviours)] / many.score_scale
        self.assertTrue((laid_out == many.scores).all())

    def test_games_keep_their_numbers(self):
        game = folk.stage_game(numpy.array([[3, 0], [5, 1]]), title="PD")
        self.assertEqual(game.payoffs(False), [["3", "0"], ["5", "1"]])
        self.assertTrue(game.is_symmetric)
        self.assertEqual(folk.tournament(game=game).scores.tolist(), folk.tournament().scores.tolist())

    def test_sets_compare_exactly(self):
        sets = folk.thresholds("spiteful", "spiteful")
        low, high = sets["nash"].intervals[0]
        self.assertTrue(low == 0.5 and low < 0.6 and high == 1 and low < high)
        self.assertIn(0.5, sets["nash"])
        self.assertNotIn(0.4999999, sets["nash"])
        self.assertFalse(folk.thresholds("pavlov", "pavlov")["nash"])


class Memory(unittest.TestCase):
    def test_ten_thousand_calls_leave_nothing(self):
        def once():
            folk.tournament("tit_for_tat,all_d", rounds=5, threads=1).scores.sum()
            folk.match("tit_for_tat", lambda history: "C", rounds=3)
            folk.check("pavlov", "pavlov", criterion="discounted:0.6", threads=1).verdicts
            folk.mpe.BatchEnv("simple_tag", 1).reset(1)

        count = 100 if SANITIZED else 10_000
        for _ in range(count // 10):
            once()
        before = resident()
        for _ in range(count):
            once()
        if not SANITIZED:
            self.assertLess(resident() - before, 5_000_000)


class Tables(unittest.TestCase):
    def test_are_records_without_pandas(self):
        code = ("import sys; sys.modules['pandas'] = None\nimport folk\nresult = folk.tournament('tit_for_tat,all_d', rounds=10)\n"
                "print(result.ranking[0]['name'], result.pairs[1]['score_b'], folk.strategies('tft')[0]['states'])")
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout, "tit_for_tat 14.0 2\n")

    def test_automata_are_graphs(self):
        try:
            import networkx
        except ImportError:
            self.skipTest("without networkx")
        graph = folk.strategy("tit_for_tat").to_networkx()
        self.assertEqual(len(graph), 2)
        self.assertTrue(networkx.is_strongly_connected(graph))
        self.assertEqual(graph.nodes[0]["cooperation"], 1)
        self.assertEqual({(a, b, data["own"], data["theirs"]) for a, b, data in graph.edges(data=True)},
                         {(0, 0, "C", "C"), (0, 1, "C", "D"), (1, 0, "D", "C"), (1, 1, "D", "D")})


@unittest.skipUnless(shutil.which("gnuplot") and shutil.which("dot"), "without gnuplot and Graphviz")
class Pictures(unittest.TestCase):
    def test_are_svg(self):
        result = folk.tournament("tit_for_tat,all_d", rounds=10)
        for text in (result.plot()._repr_svg_(), result.plot("scores").svg, folk.strategy("pavlov")._repr_svg_(),
                     folk.payoff_region(discount=0.9).plot().svg,
                     folk.evolve("all_c,all_d,tit_for_tat", rounds=10).plot("simplex").svg,
                     folk.evolve("all_c,all_d", model="birth-death", individuals=9, fixation=True).plot().svg):
            self.assertIn("<svg", text)
        self.assertIn("<html", folk.check("pavlov", "pavlov", criterion="discounted:0.6").html())
        self.assertIsNone(folk.strategy("sct")._repr_svg_())
        with self.assertRaisesRegex(folk.UsageError, "plot 'pie': there are cooperation, payoffs, scores"):
            result.plot("pie")
        with self.assertRaisesRegex(folk.UsageError, "no picture of who took over"):
            folk.evolve("all_c,all_d", model="birth-death", start="all_c=5,all_d=5", runs=2).plot()


class Import(unittest.TestCase):
    def test_loads_neither_pandas_nor_networkx(self):
        code = "import sys, folk; print([name in sys.modules for name in ('pandas', 'networkx')])"
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout, "[False, False]\n")


if __name__ == "__main__":
    unittest.main()
