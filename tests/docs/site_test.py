"""The pages as a site: it builds without a warning, and what a page of it needs or leads to is there. Skipped (77) where mkdocs is not
installed. Usage: site_test.py PROJECT"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

mkdocs = shutil.which("mkdocs")
if mkdocs is None:
    print("skipped: mkdocs is not installed (pip install mkdocs-material mkdocs-same-dir)")
    sys.exit(77)
with tempfile.TemporaryDirectory(prefix="rpf_site_") as name:
    site = Path(name)
    subprocess.run([mkdocs, "build", "--quiet", "--strict", "--site-dir", site], cwd=sys.argv[1], check=True, timeout=300,
                   env={**os.environ, "NO_MKDOCS_2_WARNING": "1", "DISABLE_MKDOCS_2_WARNING": "true"})
    dead, asked = [], 0
    for page in sorted(site.rglob("index.html")):
        for link in re.findall(r'(?:src|href)="?([^"\s>]+)', page.read_text(encoding="utf-8")):
            if not re.match(r"\w+:|#|/", link):
                asked += 1
                if not (page.parent / link.split("#")[0].split("?")[0]).exists():
                    dead.append(f"{page.relative_to(site)}: {link}")
print("\n".join(dead) or f"{asked} links and files, none missing")
sys.exit(1 if dead or asked < 1000 else 0)
