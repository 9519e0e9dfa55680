"""Compiles the extension froe._core: the core of froe and src/_core, with one C compiler and nothing else.

    python3 setup.py build_ext --inplace                              everything; about a minute on four processors
    FROE_LIBRARY=../build/libfroe.a python3 setup.py build_ext --inplace    links a library that CMake has built

Either puts _core.abi3.so beside src/froe/__init__.py. Then PYTHONPATH=src uses the package in place.

Flags that change what + - * / and sqrt give come last and are turned off: setuptools takes flags from the
interpreter's own build and from CFLAGS. The -g that Debian's brings would make the wheel several times as large. No
symbol of the core is visible from outside: several copies of froe may live in one process.
"""

import os
import re
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext
from setuptools.command.sdist import sdist

HERE = Path(__file__).resolve().parent
ROOT = HERE if (HERE / "support").is_dir() else HERE.parent  # a source distribution, or a checkout
CORE = ("src", "formats", "vector", "support")
CMAKE = (ROOT / "CMakeLists.txt").read_text()
EMBEDDED = re.search(r"froe_embed\(froe_core \S+ \S+ ([^)]+)\)", CMAKE).group(1).split()
VERSION = re.search(r"project\(froe VERSION ([0-9.]+)", CMAKE).group(1)

ARITHMETIC = ["-ffp-contract=off", "-fno-fast-math", "-fno-math-errno"]
FLAGS = ["-std=c11", "-O3", "-g0", "-fvisibility=hidden", "-pthread"] + ARITHMETIC
MACROS = [("FROE_API", ""), ("FROE_VERSION", f'"{VERSION}"'), ("_POSIX_C_SOURCE", "200809L")]


def embedded(folder):
    """The C source that holds the files within the core: what cmake/embed.cmake makes of them."""
    arrays, entries = [], []
    for number, file in enumerate(EMBEDDED):
        content = (ROOT / file).read_bytes()
        arrays.append(f"static const unsigned char file{number}[] = {{{','.join(map(str, content + bytes(1)))}}};\n")
        entries.append(f'    {{"{Path(file).name}", file{number}, {len(content)}}},\n')
    source = folder / "formats_embedded_files.c"
    source.write_text(
        '#include "formats/motion/embedded.h"\n' + "".join(arrays)
        + "const support_embedded formats_embedded_files[] = {\n" + "".join(entries) + "    {0, 0, 0},\n};\n"
    )
    return source


class BuildCore(build_ext):
    """Compiles the core into objects of its own, on all processors, unless FROE_LIBRARY names a library."""

    def build_extension(self, extension):
        library = os.environ.get("FROE_LIBRARY")
        extension.extra_objects = [library] if library else self.compile_core()
        super().build_extension(extension)

    def compile_core(self):
        folder = Path(self.build_temp) / "core"
        folder.mkdir(parents=True, exist_ok=True)
        sources = [file for part in CORE for file in sorted((ROOT / part).glob("**/*.c")) if "_core" not in file.parts]
        jobs = [(file, file.relative_to(ROOT)) for file in sources] + [(embedded(folder), Path("embedded.c"))]
        with ThreadPoolExecutor(self.parallel or os.cpu_count()) as pool:
            return list(pool.map(lambda job: self.compile_one(folder, *job), jobs))

    def compile_one(self, folder, source, name):
        target = folder / name.with_suffix(".o")
        target.parent.mkdir(parents=True, exist_ok=True)
        include = [f"-I{ROOT / part}" for part in ("include", "src", ".")]
        macros = [f"-D{name}={value}" for name, value in MACROS]
        self.spawn([*self.compiler.compiler_so, *FLAGS, *macros, *include, "-c", str(source), "-o", str(target)])
        return str(target)


class PackCore(sdist):
    """Puts the core beside the package, so that a source distribution needs nothing else."""

    def make_release_tree(self, base_dir, files):
        super().make_release_tree(base_dir, files)
        core = [ROOT / part for part in (*CORE, "include")]
        sources = [file for folder in core for file in sorted(folder.rglob("*")) if file.suffix in (".c", ".h", ".inc")
                   or file.name == "methods.def"]
        for file in [*sources, *(ROOT / name for name in (*EMBEDDED, "CMakeLists.txt", "LICENSE"))]:
            target = Path(base_dir) / file.relative_to(ROOT)
            target.parent.mkdir(parents=True, exist_ok=True)
            if not target.exists():
                self.copy_file(str(file), str(target))


setup(
    version=VERSION,
    ext_modules=[
        Extension(
            "froe._core",
            [str(file.relative_to(HERE)) for file in sorted((HERE / "src/_core").glob("**/*.c"))],
            depends=[str(file.relative_to(HERE)) for file in sorted((HERE / "src/_core").glob("**/*.h"))],
            include_dirs=[str(ROOT / "include"), str(HERE / "src/_core")],
            define_macros=[("FROE_API", "")],
            extra_compile_args=FLAGS,
            extra_link_args=["-Wl,--exclude-libs,ALL", "-pthread", "-lm"],
            py_limited_api=True,
        )
    ],
    cmdclass={"build_ext": BuildCore, "sdist": PackCore},
    options={"bdist_wheel": {"py_limited_api": "cp311"}},
)
