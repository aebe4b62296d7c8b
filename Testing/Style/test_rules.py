"""Every rule finds what it is for, and only that: run on trees made up here.

usage: test_rules.py FOLDER     writes below FOLDER
"""

import os
import shutil
import sys
import unittest

import benchmarks_compile
import contraction
import doc_rules
import quick_tests
from check_style import RULES
from source_tree import read_tree

FOLDER = "."
# Put together here, so that this file obeys the rules that it tests.
WORD = "TO" + "DO"
ADDRESS = "https:" + "//example.org"
SLASH = "/"


class RulesTest(unittest.TestCase):
    def faults(self, rule, tree):
        """(path, line) of each fault of `rule` in a tree given as {path: text}."""
        root = os.path.join(FOLDER, self.id().split(".")[-1])
        shutil.rmtree(root, ignore_errors=True)
        for path, text in tree.items():
            full = os.path.join(root, path)
            os.makedirs(os.path.dirname(full), exist_ok=True)
            with open(full, "w", encoding="utf-8") as stream:
                stream.write(text)
        return [(path, line) for path, line, _ in RULES[rule](read_tree(root))]

    def test_file_length(self):
        tree = {
            "IO/LAS/A.cxx": "int a;\n" * 451,
            "IO/LAS/B.cxx": "int a;\n" * 450,
            "IO/LAS/C.cxx": "// Longer than 450 lines: one table.\n" + "int a;\n" * 450,
            "IO/LAS/D.cxx": "// Longer than 450 lines:\n" + "int a;\n" * 450,
            "Rendering/OpenGL2/GpuPool.cxx": "int a;\n" * 599,
            "Rendering/OpenGL2/glsl/a.glsl": "int a;\n" * 151,
            "docs/long.md": "text\n" * 900,
        }
        self.assertEqual(
            self.faults("FileLength", tree),
            [("IO/LAS/A.cxx", 451), ("IO/LAS/D.cxx", 451), ("Rendering/OpenGL2/GpuPool.cxx", 599),
             ("Rendering/OpenGL2/glsl/a.glsl", 151)],
        )

    def test_papers(self):
        page = ["* *Code*: `Core/A`, `IO/A.cxx`, `Core`, `A::run`,", "  `B/Gone`, `A::gone`", "",
                "`Not/Asked`", "* *Tests*: `Suite.Draws`, `Suite.*`, `Draws...`, `Whole.TwoWords`",
                "  `Suite.Draw`, `Gone.*`, `Whole.Gone`"]
        tree = {
            "docs/papers.md": "\n".join(page) + "\n",
            "vtkmodule/Core/A.h": "struct A { void run(); };\n",
            "IO/A.cxx": "int a;\n",
            "IO/Testing/TestA.cxx": "TEST_F(Suite, DrawsAll)\nTEST(Suite, Draws)\n",
            "Testing/Whole/test_two_words.py": "pass\n",
        }
        self.assertEqual(self.faults("Papers", tree),
                         [("docs/papers.md", 2)] * 2 + [("docs/papers.md", 6)] * 3)

    def test_one_version(self):
        tree = {
            "CMakeLists.txt": "project(PointFront VERSION 3.2.1 LANGUAGES CXX)\n",
            "CHANGELOG.md": "# Changes\n\n## 3.2.1, not released\n",
            "pyproject.toml": 'version = "3.2.1"\n',
            "IO/A.cxx": "int a = 3;\n// 13.2.1 and 3.2.10\n",
        }
        self.assertEqual(self.faults("OneVersion", tree), [("pyproject.toml", 1)])
        tree["CHANGELOG.md"] = "# Changes\n\n## 3.2.0\n"
        del tree["pyproject.toml"]
        self.assertEqual(self.faults("OneVersion", tree), [("CHANGELOG.md", 3)])

    def test_folder_size(self):
        held = {
            "vtkmodule/Core/pointfront/Store": 41,
            "vtkmodule/Core/pointfront/Front": 40,
            "IO/LAS": 42,
            "IO/LAS/LAZ": 40,
            "Rendering/OpenGL2/Testing/Cxx": 43,
            "CommandLine": 44,
        }
        tree = {
            f"{folder}/A{i}.{'h' if i % 2 else 'cxx'}": "int a;\n"
            for folder, count in held.items() for i in range(count)
        }
        tree.update({f"docs/A{i}.md": "text\n" for i in range(60)})
        self.assertEqual(self.faults("FolderSize", tree), [
            ("CommandLine", 44), ("IO/LAS", 42), ("Rendering/OpenGL2/Testing/Cxx", 43),
            ("vtkmodule/Core/pointfront/Store", 41)])

    def test_formatting(self):
        tree = {
            ".clang-format": "BasedOnStyle: LLVM\n",
            "IO/LAS/A.cxx": "int a;\nint  b;\nint  c;\n",
            "IO/LAS/B.cxx": "int a;\n",
        }
        self.assertEqual(self.faults("Formatting", tree), [("IO/LAS/A.cxx", 2)])

    def test_line_length(self):
        tree = {"IO/LAS/A.cxx": "x" * 100 + "\n" + "x" * 101 + "\n", "docs/a.md": "x" * 200}
        self.assertEqual(self.faults("LineLength", tree), [("IO/LAS/A.cxx", 2)])

    def test_comment_subjects(self):
        tree = {
            "IO/LAS/A.cxx": "/// Of a node.\nint a; ///< what it holds\nint b; // end of a\n",
            "IO/LAS/B.cxx": "// It is the end\n// of a sentence.\nauto c = \"// of text\";\n",
            "IO/LAS/C.glsl": "float share; // of its size\n",
        }
        self.assertEqual(
            self.faults("CommentSubjects", tree),
            [("IO/LAS/A.cxx", 1), ("IO/LAS/A.cxx", 2), ("IO/LAS/C.glsl", 1)],
        )

    def test_comment_subjects_of_scripts(self):
        """Docstrings, comments of Python, CMake and shell; not text, nor lines that go on."""
        python = ('"""Of\na module."""\nA = "# of text"  # of a\n\n\ndef f():\n'
                  '    """What f does."""\n'
                  "    # It is the end\n    # of a sentence.\n    return A  #: What A is\n")
        tree = {
            "scripts/a": "#!/usr/bin/python3\n" + python,
            "x/b.py": python,
            "x/CMakeLists.txt": "set(a \"# of text\") # of a\n# The end\n# of a sentence.\n",
            "scripts/c": "#!/bin/sh\necho '# what' ${#of} # what c says\n\n# Of c.\necho\n",
            "docs/a.md": "# Of a page\n",
        }
        lines = [1, 3, 7, 10]
        self.assertEqual(
            sorted(self.faults("CommentSubjects", tree)),
            [*[("scripts/a", line + 1) for line in lines], ("scripts/c", 2), ("scripts/c", 4),
             ("x/CMakeLists.txt", 1), *[("x/b.py", line) for line in lines]],
        )

    def test_function_length(self):
        at = "  call();\n" * 57  # and a line of head and two of braces
        more = at + "  call();\n"
        tree = {
            "IO/LAS/A.cxx": f"namespace n\n{{\n\nvoid f(int a,\n  int b)\n{{\n{at}}}\n}}\n",
            "IO/LAS/B.cxx": f"namespace n\n{{\n\nvoid f()\n{{\n{at}}}\n\nvoid g()\n{{\n{at}}}\n}}",
            "IO/LAS/C.h": f"class C\n{{\n  int f() const\n  {{\n{more}  }}\n}};\n",
        }
        self.assertEqual(
            self.faults("FunctionLength", tree), [("IO/LAS/A.cxx", 4), ("IO/LAS/C.h", 3)]
        )

    def test_machine_paths(self):
        tree = {
            "docs/a.md": f"see {SLASH}home{SLASH}me\n",
            "docs/b.md": "see /usr/lib and a/tmp/b\n",
        }
        self.assertEqual(self.faults("MachinePaths", tree), [("docs/a.md", 1)])

    def test_interpreters(self):
        tree = {
            "scripts/a": "#!/usr/bin/env python3\n",
            "scripts/b": "#!/usr/bin/python3\n",
            "scripts/c": "#!/bin/sh\nexec python\n",
            "x/d.py": "#!/usr/bin/python\n",
            "x/e.py": "import os\n",
        }
        self.assertEqual(self.faults("Interpreters", tree), [("scripts/a", 1), ("x/d.py", 1)])

    def test_addresses(self):
        tree = {
            "scripts/a": f"curl {ADDRESS}\n",
            "x/CMakeLists.txt": f"# {ADDRESS}\n",
            "docs/a.md": ADDRESS,
            "scripts/b": "print('http:" + "//localhost:8080/')\n",
        }
        self.assertEqual(
            self.faults("Addresses", tree), [("scripts/a", 1), ("x/CMakeLists.txt", 1)]
        )

    def test_unfinished(self):
        tree = {"IO/LAS/A.cxx": f"\n// {WORD} later\n", "IO/LAS/B.cxx": "// a studio\n"}
        self.assertEqual(self.faults("Unfinished", tree), [("IO/LAS/A.cxx", 2)])

    def test_idle_tests(self):
        idle = "EXPECT_" + "TRUE(true);"
        tree = {
            "IO/LAS/Testing/TestA.cxx": idle + "\n",
            "IO/LAS/Testing/TestB.cxx": "EXPECT_TRUE(a);",
        }
        self.assertEqual(self.faults("IdleTests", tree), [("IO/LAS/Testing/TestA.cxx", 1)])

    def test_quiet_libraries(self):
        tree = {
            "IO/LAS/A.cxx": "exit(1);\nstd::cout << 1;\n",
            "IO/LAS/B.cxx": '// exit(1)\nauto s = "exit(1)";\nstd::snprintf(b, 1, s);\n',
            "IO/LAS/C.cxx": "try\n{\n}\ncatch (...)\n{\n}\n",
            "IO/LAS/Testing/TestA.cxx": "std::cout << 1;\n",
            "CommandLine/main.cxx": "std::cout << 1;\n",
        }
        self.assertEqual(
            self.faults("QuietLibraries", tree),
            [("IO/LAS/A.cxx", 1), ("IO/LAS/A.cxx", 2), ("IO/LAS/C.cxx", 4)],
        )

    def test_letters(self):
        tree = {
            "IO/LAS/A.cxx": "std::toupper(c);\nstd::isspace(c);\nstd::isdigit(c);\n",
            "IO/LAS/B.cxx": "// std::tolower(c)\nisAsciiSpace(c);\n",
            "IO/LAS/Testing/TestA.cxx": "std::isalnum(c);\n",
            "CommandLine/C.cxx": "std::isalpha(c);\nstd::strtod(text, &end);\n",
            "IO/Remote/D.cxx": "std::strtod(text, &end);\ntakeNumber(text);\n",
            "IO/Remote/E.cxx": 'f(t, "of %.3f", x);\nf(t, "%d %+g m", n, x);\n  "%-8.*e",\n',
            "IO/Remote/F.cxx": 'f("%02x %s%%, %5d", n, s);\n"a%20b%2fc", "100 % for", "5%.";\n',
            "CommandLine/G.cxx": 'std::printf("%.3f", x);\n',
        }
        self.assertEqual(
            self.faults("Letters", tree),
            [("CommandLine/C.cxx", 1), ("IO/LAS/A.cxx", 1), ("IO/LAS/A.cxx", 2),
             ("IO/Remote/D.cxx", 1), *(("IO/Remote/E.cxx", line) for line in (1, 2, 3))],
        )

    def test_links(self):
        tree = {
            "docs/a.md": f"[b](b.md#part) [up](../IO) [host]({ADDRESS})\n![no](images/c.png)\n",
            "docs/b.md": "",
            "IO/A.cxx": "",
        }
        self.assertEqual(self.faults("Links", tree), [("docs/a.md", 2)])

    def test_anchors(self):
        tree = {
            "docs/a.md": "# On `a`, (b)\n[b](b.md#two-words) [a](#on-a-b)\n[no](b.md#three)\n"
            "[no](#b)\n",
            "docs/b.md": "## Two words\n",
            "IO/A.cxx": "",
        }
        self.assertEqual(self.faults("Anchors", tree), [("docs/a.md", 3), ("docs/a.md", 4)])

    def test_linked_names(self):
        tree = {
            "docs/a.md": "[`View`](../IO/View.h) [`View.h`](../IO/View.h)\n"
            "[`Pool::size()`](../IO/View.h)\n"
            "[`Gone`](../IO/Gone.h)\n",
            "IO/View.h": "struct View\n{\n  int size;\n};\n",
        }
        self.assertEqual(self.faults("LinkedNames", tree), [("docs/a.md", 2)])

    def test_table_commands(self):
        rows = "| points | ms |\n| --- | --- |\n| 1 M | 2.5 |\n"
        begin, end = "<!-- table: Testing/Benchmarks/{} x -->\n", "<!-- end of table -->\n"
        tree = {
            "README.md": "| what | how |\n| --- | --- |\n| reads | LAS 1.4 |\n\n"
            + rows + "\n" + begin.format("there.py") + rows + end + begin.format("gone.py") + rows,
            "docs/tradeoffs.md":
                "<!-- table 2: pointfrontRasterBenchmark -->\n" + rows + end
                + "<!-- table: pointfrontGoneBenchmark -->\n" + rows + end
                + "<!-- table by hand: pointfrontRasterBenchmark -->\n" + rows + end,
            "docs/other.md": rows,
            "Testing/Benchmarks/there.py": "",
            "Testing/Benchmarks/raster.cxx": "",
        }
        self.assertEqual(self.faults("TableCommands", tree), [
            ("README.md", 5), ("README.md", 14), ("README.md", 15), ("docs/tradeoffs.md", 6),
            ("docs/tradeoffs.md", 12)])

    def test_old_tables(self):
        rows, end = "| points | ms |\n| --- | --- |\n| 1 M | 2.5 |\n", "<!-- end of table -->\n"
        command = "Testing/Benchmarks/a.py x"
        fresh = f"{doc_rules.digest(command)} {doc_rules.digest('print(1)')}"
        for source, faults in (("print(1)", []), ("print(2)", [("README.md", 1)])):
            tree = {"README.md": f"<!-- table: {command} -->\n" + rows + end,
                    "Testing/Benchmarks/a.py": source, doc_rules.MADE: f"{fresh}\n"}
            self.assertEqual(self.faults("OldTables", tree), faults)
        command = "Testing/Benchmarks/promise.py x"
        program, picture = "print(1)", "1 picture: ewa"
        fresh = f"{doc_rules.digest(command)} {doc_rules.digest(program + picture)}"
        for results, faults in (([picture, "2 index"], []), ([picture, "3 index"], []),
                                (["4 picture: ewa", "2 index"], [("README.md", 1)])):
            tree = {"README.md": f"<!-- table: {command} -->\n" + rows + end,
                    "Testing/Benchmarks/promise.py": program,
                    doc_rules.RESULTS: "\n".join(results) + "\n",
                    doc_rules.MADE: f"{fresh}\n"}
            self.assertEqual(self.faults("OldTables", tree), faults)

    def test_contraction(self):
        compiled = {"a.cxx": "c++ -O3 -ffp-contract=off -c a.cxx", "b.cxx": "c++ -O3 -c b.cxx",
                    "c.cxx": "c++ -ffp-contract=off -ffp-contract=fast -c c.cxx",
                    "d.c": "cc -c d.c",
                    "e.cxx": "c++ -Ofast -ffp-contract=off -c e.cxx"}
        commands = [{"file": file, "command": command} for file, command in compiled.items()]
        self.assertEqual(contraction.contracting(commands), ["b.cxx", "c.cxx", "e.cxx"])

    def test_benchmarks_compile(self):
        folder = os.path.join(FOLDER, "benchmarks")
        os.makedirs(folder, exist_ok=True)
        sources = {"good.cxx": "int main() {}\n", "bad.cxx": "int main() { a(); }\n"}
        for name, text in sources.items():
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)
        commands = [{"file": name, "directory": folder, "command":
                     f"c++ -MD -MT {name}.o -MF {name}.d -o {name}.o -c {name}"}
                    for name in ("good.cxx", "bad.cxx")]
        self.assertEqual(benchmarks_compile.broken(commands), ["bad.cxx"])
        self.assertEqual(sorted(os.listdir(folder)), ["bad.cxx", "good.cxx"])

    def include_faults(self, path, header):
        known = {
            name: "int a;\n"
            for name in (
                "vtkmodule/Core/pointfront/Store/PointStore.h",
                "vtkmodule/Common/vtkPointFrontStore.h",
                "IO/LAS/LASFormat.h",
                "IO/Text/XYZWriter.h",
                "Rendering/Core/vtkPointFrontMapper.h",
                "Rendering/OpenGL2/GpuPool.h",
                "Rendering/Software/SoftwareTarget.h",
                "Filters/Build/vtkBuild.h",
                "Testing/Support/Clouds.h",
                "IO/LAS/Testing/Files.h",
                "paraview-plugin/Representation.h",
            )
        }
        known[path] = f"#include {header}\n"
        return len(self.faults("Includes", known))

    def test_includes_that_are_refused(self):
        for path, header in (
            ("vtkmodule/Core/pointfront/Store/A.cxx", '"vtkObject.h"'),
            ("vtkmodule/Core/pointfront/Store/A.cxx", "<GL/gl.h>"),
            ("vtkmodule/Core/pointfront/Store/A.cxx", "<pcl/point_types.h>"),
            ("vtkmodule/Core/pointfront/Store/A.cxx", "<OpenImageIO/imageio.h>"),
            ("vtkmodule/Core/pointfront/Store/A.cxx", "<laszip/laszip_api.h>"),
            ("vtkmodule/Core/pointfront/Store/A.cxx", '"LASFormat.h"'),
            ("vtkmodule/Common/a.cxx", '"vtkPointFrontMapper.h"'),
            ("IO/LAS/A.cxx", '"vtkPointFrontMapper.h"'),
            ("IO/LAS/A.cxx", '"XYZWriter.h"'),
            ("IO/LAS/A.cxx", '"vtkBuild.h"'),
            ("IO/LAS/A.h", "<laszip/laszip_api.h>"),
            ("IO/LAS/A.cxx", '"Testing/Files.h"'),
            ("IO/Text/A.cxx", "<laszip/laszip_api.h>"),
            ("IO/Text/A.cxx", "<gtest/gtest.h>"),
            ("Filters/Build/A.cxx", '"LASFormat.h"'),
            ("Filters/Build/A.cxx", "<flann/flann.hpp>"),
            ("Rendering/Core/A.cxx", '"GpuPool.h"'),
            ("Rendering/Core/A.cxx", '"vtk_glew.h"'),
            ("Rendering/Core/A.cxx", '"SoftwareTarget.h"'),
            ("Rendering/OpenGL2/A.cxx", '"LASFormat.h"'),
            ("Rendering/OpenGL2/A.cxx", '"Clouds.h"'),
            ("Rendering/OpenGL2/A.cxx", '"vtkPVRenderView.h"'),
            ("IO/Store/A.cxx", '"Representation.h"'),
            ("Examples/Cxx/A/main.cxx", '"../../../IO/LAS/LASFormat.h"'),
            ("Testing/Consumer/A/main.cxx", '"../../Support/Clouds.h"'),
        ):
            with self.subTest(path=path, header=header):
                self.assertEqual(self.include_faults(path, header), 1)

    def test_includes_that_are_allowed(self):
        for path, header in (
            ("vtkmodule/Core/pointfront/Store/A.cxx", '"pointfront/Store/PointStore.h"'),
            ("vtkmodule/Core/pointfront/Store/A.cxx", "<glm/vec3.hpp>"),
            ("vtkmodule/Core/Testing/TestA.cxx", '"LASFormat.h"'),
            ("vtkmodule/Common/a.cxx", '"pointfront/Store/PointStore.h"'),
            ("IO/LAS/A.cxx", "<laszip/laszip_api.h>"),
            ("IO/LAS/A.cxx", '"LASFormat.h"'),
            ("IO/LAS/Testing/TestA.cxx", "<gtest/gtest.h>"),
            ("Filters/Normals/A.cxx", "<pcl/point_types.h>"),
            ("Rendering/OpenGL2/A.cxx", '"vtkPointFrontMapper.h"'),
            ("Rendering/OpenGL2/A.cxx", '"SoftwareTarget.h"'),
            ("Rendering/OpenGL2/A.cxx", '"vtk_glew.h"'),
            ("paraview-plugin/A.cxx", '"vtkPVRenderView.h"'),
            ("paraview-plugin/A.cxx", '"vtkPointFrontMapper.h"'),
            ("CommandLine/A.cxx", '"XYZWriter.h"'),
            ("Examples/Cxx/A/main.cxx", '"vtkPointFrontMapper.h"'),
        ):
            with self.subTest(path=path, header=header):
                self.assertEqual(self.include_faults(path, header), 0)

    def test_kernel_order(self):
        floors = "```\n floor   files     pictures\n\n  2                Front\n" \
                 "  1      Store     Style\n  0      Base\n```\n"
        core = "vtkmodule/Core/pointfront/"
        tree = {
            "docs/developer/rooms.md": floors,
            core + "Base/A.h": "#include <array>\n",
            core + "Store/B.h": '#include "pointfront/Base/A.h"\n#include "pointfront/Store/D.h"\n',
            core + "Style/C.h": '#include "pointfront/Base/A.h"\n',
            core + "Front/E.cxx": '#include "pointfront/Store/B.h"\n',
        }
        self.assertEqual(self.faults("KernelOrder", tree), [])
        for room, text in (
            ("Base", '#include "pointfront/Store/B.h"'),  # closes a circle
            ("Store", '#include "pointfront/Style/C.h"'),  # on the same floor
            ("Store", '#include "pointfront/Front/E.h"'),
            ("Front", '#include "B.h"'),
            ("Front", '#include "pointfront/Attic/B.h"'),
        ):
            with self.subTest(room=room, text=text):
                path = f"{core}{room}/F.cxx"
                faults = self.faults("KernelOrder", {**tree, path: f"int f;\n{text}\n"})
                self.assertEqual(faults, [(path, 2)])
        self.assertEqual(self.faults("KernelOrder", {**tree, core + "Attic/F.cxx": "int f;\n"}),
                         [(core + "Attic/F.cxx", 1)])
        del tree[core + "Front/E.cxx"]
        self.assertEqual(self.faults("KernelOrder", tree), [("docs/developer/rooms.md", 1)])

    def test_module_edges(self):
        core = "NAME\n  PointFront::RenderingCore\nDEPENDS\n  VTK::RenderingCore\n"
        store = "NAME\n  PointFront::IOStore\nDEPENDS\n  PointFront::RenderingCore\n"
        gl = "NAME\n  PointFront::RenderingOpenGL2\nDEPENDS\n  PointFront::RenderingCore\n"
        tree = {
            "Rendering/Core/vtk.module": core,
            "Rendering/OpenGL2/vtk.module": gl,
            "IO/Store/vtk.module": store,
        }
        self.assertEqual(self.faults("ModuleEdges", tree), [("IO/Store/vtk.module", 4)])


    def test_quick_tests(self):
        tests = ["Whole.Long", "Whole.Short", "Suite.One", "Suite.Two"]
        self.assertEqual(list(quick_tests.faults("# why\nWhole[.]Long Whole.Short Suite\n", tests)),
                         [])
        for line, fault in (("Whole[.]Longer Whole.Short", "no test is called"),
                            ("Whole[.]Long", "name the tests"),
                            ("Whole[.]Long Whole.Shorter", "there is no test"),
                            ("Whole[.].* Whole.Short", "is left out itself"),
                            ("(W)(h)(o)(l)(e)[.](L)(o)(n)(g) Suite", "9 groups")):
            found = list(quick_tests.faults(line + "\n", tests))
            self.assertEqual(len(found), 1, found)
            self.assertIn(fault, found[0])


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    FOLDER = sys.argv.pop()
    unittest.main()
