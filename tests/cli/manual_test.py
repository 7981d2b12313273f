"""Manual page and completion are made of the options' own texts, and every shell takes them. Usage: manual_test.py RPF PROJECT"""
import os
import shutil
import subprocess
import unittest

from command_case import RPF, CommandCase


def manual(form):
    return subprocess.run([RPF, "manual", form], capture_output=True, text=True, check=True).stdout


class ManualTest(CommandCase):
    def run_shell(self, *command):
        if shutil.which(command[0]) is None:
            self.skipTest(f"{command[0]} is not installed")
        result = subprocess.run(command, capture_output=True, text=True, check=False, timeout=60, cwd=self.folder, env={**os.environ, "HOME": str(self.folder), "TERM": "dumb"})
        self.expect(result, 0)
        return result.stdout

    def test_the_page_has_all_options_and_commands(self):
        page = manual("man").replace("\\-", "-")
        help_ = subprocess.run([RPF, "--help"], capture_output=True, text=True, check=True).stdout
        for word in help_.split():
            if word.startswith("--"):
                self.assertIn(word.strip("`.,;"), page)
        for command in ("info", "compare", "bench frames", "study"):
            self.assertIn(f".SS rpf {command}\n", page)
        self.assertNotIn(".SS rpf manual", page)

    def test_the_page_is_roff(self):
        page = self.folder / "rpf.1"
        page.write_text(manual("man"))
        if shutil.which("groff") is None:
            self.skipTest("groff is not installed")
        result = subprocess.run(["groff", "-man", "-ww", "-z", str(page)], capture_output=True, text=True, check=False)
        self.assertEqual(result.stderr, "")

    def complete(self, *words):
        (self.folder / "rpf.bash").write_text(manual("bash"))
        line = " ".join(f"'{word}'" for word in ("rpf", *words))
        return self.run_shell("bash", "-c", f"source ./rpf.bash; COMP_WORDS=({line}); COMP_CWORD={len(words)}; _rpf; printf '%s\\n' \"${{COMPREPLY[@]}}\"").split()

    def test_bash_completes(self):
        self.assertIn("--preset", self.complete("--pre"))
        self.assertEqual(self.complete("--preset", "b"), ["balanced"])
        self.assertEqual(self.complete("info", "--m"), ["--map", "--max-memory"])
        self.assertIn("compare", self.complete(""))
        self.assertIn("--set", self.complete("bench", "frames", "--"))
        self.assertEqual(self.complete("in"), [])  # a file's name: bash's own

    def test_fish_completes(self):
        (self.folder / "rpf.fish").write_text(manual("fish"))
        self.assertIn("--preset", self.run_shell("fish", "-c", "source rpf.fish; complete -C 'rpf --pre'"))
        self.assertIn("balanced", self.run_shell("fish", "-c", "source rpf.fish; complete -C 'rpf --preset b'"))

    def test_zsh_takes_it(self):
        (self.folder / "_rpf").write_text(manual("zsh"))
        self.run_shell("zsh", "-n", "_rpf")
        told = self.run_shell("zsh", "-fc", "_arguments() { print -l -- $options }; source ./_rpf")
        self.assertIn("--preset=", told)
        self.assertIn("(fast balanced high)", told)


if __name__ == "__main__":
    unittest.main(argv=["manual_test.py"])
