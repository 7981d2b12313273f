"""Doxygen makes pages of include/rpf without a warning, except that data members whose names say all may go without a
text. Skipped (77) where doxygen is not installed. Usage: reference_test.py PROJECT"""
import os
import shutil
import subprocess
import sys
import tempfile

project = sys.argv[1]
if shutil.which("doxygen") is None:
    print("skipped: doxygen is not installed (Debian: apt-get install doxygen)")
    sys.exit(77)
with tempfile.TemporaryDirectory() as folder:
    copy = os.path.join(folder, "project")  # Doxygen 1.9.4 finds no page from another where a blank is in the path
    for part in ("include", "docs", "cmake"):
        shutil.copytree(os.path.join(project, part), os.path.join(copy, part))
    result = subprocess.run(["doxygen", "cmake/Doxyfile"], cwd=copy, env={**os.environ, "RPF_REFERENCE_FOLDER": folder},
                            capture_output=True, text=True, check=True, timeout=300)
    warnings = [line for line in result.stderr.splitlines() if line and not line.endswith("is not documented.") or "(function)" in line or "Compound" in line]
    pages = os.listdir(os.path.join(folder, "html"))
print("\n".join(warnings) or f"{len(pages)} pages, no warning")
sys.exit(1 if warnings or len(pages) < 50 else 0)
