"""The Debian packages of `cmake --workflow --preset package`: what lintian says, and what they are in a fresh Debian 12.
Skipped (77) where they or a tool are not there. Usage: packages_test.py lintian|fresh_root PROJECT"""
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "docs"))
from pages import run_by

PROJECT = Path(sys.argv[2]).resolve()
PACKAGES = sorted((PROJECT / "build" / "packages").glob("*.deb"))
# Inside the root: installed as docs/packages.md says, with their dependencies; a frame on both backends; page, completion; a program that is built; gone again.
INSIDE = r"""
set -eu
printf 'APT::Get::Assume-Yes "true";\nAPT::Install-Recommends "false";\n' > /etc/apt/apt.conf.d/99test
mkdir /build && ln -s /packages /build/packages
find / -xdev -not -path '/proc/*' | sort > /before
(cd / && . /packages/install.sh) >/dev/null
apt-get install -qq pocl-opencl-icd >/dev/null
rpf --version
for backend in cpu opencl; do rpf /packages/in.exr -o /tmp/$backend.exr --backend $backend; done
rpf /tmp/cpu.exr -o /tmp/a.png --method gaussian -q
zcat /usr/share/man/man1/rpf.1.gz | grep -q -- preset
test -s /usr/share/bash-completion/completions/rpf; test -s /usr/share/zsh/vendor-completions/_rpf; test -s /usr/share/fish/vendor_completions.d/rpf.fish
apt-get install -y -qq --no-install-recommends /packages/librpf-dev_*.deb g++ pkg-config >/dev/null
c++ -std=c++17 /packages/filter_file.cpp -o /tmp/filter_file $(pkg-config --cflags --libs rpf)
/tmp/filter_file /packages/in.exr /tmp/library.exr
dpkg -L rpf librpf0 librpf-dev | sort -u > /ours
apt-get purge -y -qq rpf librpf0 librpf-dev >/dev/null
while read -r path; do grep -qxF "$path" /before || test ! -f "$path" || { echo "left: $path"; exit 1; }; done < /ours
find / -xdev -name '*rpf*' | sort > /after
left=$(grep -vxF -f /before /after | grep -vE '^/(packages|tmp|proc|sys|root/\.cache|var/cache|var/log)(/|$)' || true)
left=$(for path in $left; do dpkg -S "$path" >/dev/null 2>&1 || echo "$path"; done)  # linux-libc-dev and ogdi have such names too
test -z "$left" || { echo "left: $left"; exit 1; }
"""


def skip(text):
    print("skipped:", text)
    sys.exit(77)


def lintian():
    if shutil.which("lintian") is None:
        skip("lintian is not installed (Debian: apt-get install lintian)")
    return subprocess.run(["lintian", "--allow-root", "--fail-on", "error", *map(str, PACKAGES)], check=False).returncode


def fresh_root():
    if shutil.which("mmdebstrap") is None:
        skip("mmdebstrap is not installed (Debian: apt-get install mmdebstrap)")
    with tempfile.TemporaryDirectory(prefix="rpf_packages_") as folder:
        root, packages = Path(folder) / "root", Path(folder) / "packages"
        packages.mkdir()
        for file in [*PACKAGES, PROJECT / "examples" / "filter_file.cpp"]:
            shutil.copy(file, packages)
        shutil.copy(PROJECT / "examples" / "dof-spheres.samples.exr", packages / "in.exr")
        (packages / "inside.sh").write_text(INSIDE)
        (packages / "install.sh").write_text(run_by(PROJECT, "packages.fresh_root"))
        made = subprocess.run(["mmdebstrap", "--variant=apt", f"--customize-hook=copy-in {packages} /", "--customize-hook=chroot \"$1\" sh /packages/inside.sh",
                               "bookworm", str(root)], check=False)
    return made.returncode


if not PACKAGES:
    skip("no packages: cmake --workflow --preset package makes them")
sys.exit({"lintian": lintian, "fresh_root": fresh_root}[sys.argv[1]]())
