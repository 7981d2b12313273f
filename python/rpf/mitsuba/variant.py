"""Which of Mitsuba's variants runs on this machine."""
import glob
import os

import mitsuba as mi

# Debian's names. Version 15 aborts inside Mitsuba 3.9.
_LIBLLVM = "/usr/lib/*-linux-gnu/libLLVM*.so*"
_OLDEST_LLVM = 16


def _llvm_version(path):
    digits = os.path.basename(path).replace("libLLVM-", "").replace("libLLVM.so.", "").split(".")[0]
    return int(digits) if digits.isdigit() else 0


def select_variant(name="llvm_ad_rgb"):
    """Selects a variant and, where Dr.Jit would not find it, the newest LLVM of the system. Does nothing if one is selected."""
    if mi.variant() is not None:
        return
    libraries = sorted((path for path in glob.glob(_LIBLLVM) if _llvm_version(path) >= _OLDEST_LLVM), key=_llvm_version)
    if name.startswith("llvm") and libraries:
        os.environ.setdefault("DRJIT_LIBLLVM_PATH", libraries[-1])
    mi.set_variant(name)
