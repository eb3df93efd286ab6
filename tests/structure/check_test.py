#!/usr/bin/env python3
"""Plants faults in a small tree and sees that each check finds its own, and nothing in a good one."""

import pathlib
import tempfile
import unittest

import dependencies
import form


class Checks(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        self.write(".packages.txt", "# Comment\ncmake\nmake\n")
        self.write("runtime/type.h", "#include <string>\n")
        self.write("runtime/CMakeLists.txt",
                   "nacre_library(nacre_runtime\n  b.cpp  # why\n  z.cpp)\n")
        self.write("jit/api/include/nacre/nacre.h",
                   "#include <nacre/report.h>\n#include <stddef.h>\n")
        self.write("jit/document/read.cpp", '#include <pugixml.hpp>\n#include "runtime/type.h"\n')
        self.write("jit/llvm/emit.cpp", "#include <llvm/IR/Module.h>\n")
        self.write("jit/graph/resolve.h", '#include "jit/document/read.cpp"\n')

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def assert_finds(self, check, where):
        faults = check(self.root)
        self.assertEqual(len(faults), 1, faults)
        self.assertTrue(faults[0].startswith(where), faults[0])

    def test_good_tree(self):
        for check in dependencies.CHECKS + form.CHECKS:
            self.assertEqual(check(self.root), [], check.__name__)

    def test_runtime_includes_jit(self):
        self.write("runtime/bad.h", '\n#include "jit/graph/resolve.h"\n')
        self.assert_finds(dependencies.folders, "runtime/bad.h:2:")

    def test_nodes_include_pbs(self):
        self.write("pbs/fresnel.h", "")
        self.write("nodes/bad.h", '#  include "pbs/fresnel.h"\n')
        self.assert_finds(dependencies.folders, "nodes/bad.h:1:")

    def test_bench_includes_examples(self):
        self.write("bench/bad.cpp", '#include "examples/scene.h"\n')
        self.assert_finds(dependencies.folders, "bench/bad.cpp:1:")

    def test_only_tests_of_examples_include_examples(self):
        self.write("tests/examples/good.cpp", '#include "examples/scene.h"\n')
        self.write("tests/runtime/bad.cpp", '#include "examples/scene.h"\n')
        self.assert_finds(dependencies.folders, "tests/runtime/bad.cpp:1:")

    def test_graph_includes_llvm_stage(self):
        self.write("jit/graph/bad.h", '#include "jit/llvm/emit.cpp"\n')
        self.assert_finds(dependencies.stages, "jit/graph/bad.h:1:")

    def test_room_includes_later_room(self):
        self.write("jit/graph/color/bad.h", '#include "jit/graph/check/check.h"\n')
        self.assert_finds(dependencies.stages, "jit/graph/color/bad.h:1:")

    def test_file_of_no_stage(self):
        self.write("jit/bad.h", "\n")
        self.assert_finds(dependencies.stages, "jit/bad.h:")

    def test_relative_include(self):
        self.write("runtime/bad.cpp", '#include "type.h"\n')
        self.assert_finds(dependencies.paths, "runtime/bad.cpp:1:")

    def test_llvm_outside_its_folder(self):
        self.write("jit/passes/bad.cpp", '#include "llvm/IR/IRBuilder.h"\n')
        self.assert_finds(dependencies.quarantine, "jit/passes/bad.cpp:1:")

    def test_pugixml_outside_its_folder(self):
        self.write("jit/graph/bad.cpp", "#include <pugixml.hpp>\n")
        self.assert_finds(dependencies.quarantine, "jit/graph/bad.cpp:1:")

    def test_openimageio_outside_its_module(self):
        self.write("runtime/texture/openimageio/good.cpp", "#include <OpenImageIO/imageio.h>\n")
        self.write("runtime/texture/bad.cpp", "#include <OpenImageIO/imageio.h>\n")
        self.assert_finds(dependencies.quarantine, "runtime/texture/bad.cpp:1:")

    def test_embree_outside_examples(self):
        self.write("runtime/bad.cpp", "#include <embree3/rtcore.h>\n")
        self.assert_finds(dependencies.quarantine, "runtime/bad.cpp:1:")

    def test_nanobind_outside_its_folder(self):
        self.write("jit/api/bad.cpp", "#include <nanobind/nanobind.h>\n")
        self.assert_finds(dependencies.quarantine, "jit/api/bad.cpp:1:")

    def test_interface_includes_what_is_not_installed(self):
        self.write("jit/api/include/nacre/bad.h", '#include "runtime/type.h"\n')
        self.assert_finds(dependencies.public, "jit/api/include/nacre/bad.h:1:")

    def test_interface_includes_fmt(self):
        self.write("jit/api/include/nacre/bad.hpp", "#include <fmt/format.h>\n")
        self.assert_finds(dependencies.public, "jit/api/include/nacre/bad.hpp:1:")

    def test_long_file(self):
        self.write("runtime/good.cpp", "\n" * 500)
        self.write("runtime/bad.cpp", "\n" * 501)
        self.assert_finds(form.length, "runtime/bad.cpp:")

    def test_unsorted_sources(self):
        self.write("pbs/CMakeLists.txt", "nacre_library(nacre_pbs\n  b.cpp\n  a.cpp)\n")
        self.assert_finds(form.cmake_lists, "pbs/CMakeLists.txt:")

    def test_unsorted_test_folders(self):
        self.write("tests/CMakeLists.txt", "add_subdirectory(b)\nadd_subdirectory(a)\n")
        self.assert_finds(form.cmake_lists, "tests/CMakeLists.txt:")

    def test_unsorted_marked_list(self):
        self.write("nodes/list.cpp", "// keep-sorted start\nb,\na,\n// keep-sorted end\n")
        self.assert_finds(form.marked_lists, "nodes/list.cpp:4:")

    def test_marked_list_without_end(self):
        self.write("nodes/list.cpp", "// keep-sorted start\na,\n")
        self.assert_finds(form.marked_lists, "nodes/list.cpp:")

    def test_tests_of_no_folder(self):
        self.write("tests/jit/graph/independent/good.cpp", "")
        self.write("tests/support/good.h", "")
        self.write("tests/jit/graphs/bad_test.cpp", "")
        self.assert_finds(form.mirror, "tests/jit/graphs/bad_test.cpp:")

    def test_fixed_temporary_folder(self):
        self.write("tests/jit/graph/bad_test.cpp", "fs::path(::testing::TempDir()) / \"a\";\n")
        self.assert_finds(form.temporary, "tests/jit/graph/bad_test.cpp:1:")

    def test_package_twice(self):
        self.write(".packages.txt", "cmake\ncmake\n")
        self.assert_finds(form.packages, ".packages.txt:")

    def test_unsorted_packages_of_one_target(self):
        self.write(".packages-docs.txt", "graphviz\ndoxygen\n")
        self.assert_finds(form.packages, ".packages-docs.txt:")


if __name__ == "__main__":
    unittest.main()
