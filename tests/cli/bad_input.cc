// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Malformed scenes and command lines, each with the message that a user gets.

#include "tetradapt/cli/load_scene.h"
#include "tetradapt/core/exceptions.h"

#include <filesystem>
#include <fstream>
#include <iostream>

namespace core = tetradapt::core;
namespace cli  = tetradapt::cli;

namespace
{
  /** A valid scene, a line each; line numbers in messages are those here. */
  const std::vector<std::string> good{"set Degree = 1",                // 1
                                      "subsection Mesh",               // 2
                                      "  set Type = box",              // 3
                                      "  set Upper corner = 10, 1, 1", // 4
                                      "end",                           // 5
                                      "subsection Materials",          // 6
                                      "  subsection bone",             // 7
                                      "    set Young modulus = 1000",  // 8
                                      "    set Poisson ratio = 0.3",   // 9
                                      "  end",                         // 10
                                      "end",                           // 11
                                      "subsection Supports",           // 12
                                      "  subsection foot",             // 13
                                      "    set Where = x < 1e-9",      // 14
                                      "  end",                         // 15
                                      "end",                           // 16
                                      "subsection Loads",              // 17
                                      "  subsection tip",              // 18
                                      "    set Groups = x-max",        // 19
                                      "    set Value = 0; 0; -1",      // 20
                                      "  end",                         // 21
                                      "end"};                          // 22

  std::string
  text_of(const std::vector<std::string> &lines)
  {
    std::string text;
    for (const auto &line : lines)
      text += line + "\n";
    return text;
  }

  /** The good scene with line @p number replaced by @p text. */
  std::string
  with_line(const unsigned int number, const std::string &text)
  {
    auto lines        = good;
    lines[number - 1] = text;
    return text_of(lines);
  }

  /** The good scene and more after it. */
  std::string
  and_then(const std::string &text)
  {
    return text_of(good) + text + "\n";
  }

  void
  write(const std::string &name, const std::string &text)
  {
    std::ofstream(name, std::ios::binary) << text;
  }

  /** Folders of the machine and muParser's own words, which differ from version to
   * version, have no place in the expected messages. */
  std::string
  portable(std::string text)
  {
    const std::string here = std::filesystem::current_path().string() + "/";
    for (auto at = text.find(here); at != std::string::npos; at = text.find(here))
      text.replace(at, here.size(), "");
    const std::string unread = "cannot be read: ";
    for (auto at = text.find(unread); at != std::string::npos; at = text.find(unread, at + 1))
      text.replace(at + unread.size(), text.find('\n', at) - at - unread.size(), "...");
    return text;
  }

  unsigned int n_cases = 0, n_refused = 0;

  void
  load(const std::string &what, const std::string &file, const cli::Options &options)
  {
    ++n_cases;
    std::cout << what << ": ";
    try
      {
        const auto  scene = cli::load_scene(file, options);
        std::string runs;
        if (!scene.variations.empty())
          for (const auto &run : cli::load_study(scene, options))
            runs += (runs.empty() ? ": " : ", ") + run.name;
        std::cout << "accepted" << runs << '\n';
      }
    catch (const core::InputError &error)
      {
        ++n_refused;
        std::cout << portable(error.what()) << '\n';
      }
  }

  void
  scene(const std::string &what, const std::string &text)
  {
    write("s.prm", text);
    load(what, "s.prm", cli::Options());
  }

  void
  setting(const std::string &what, const std::string &text)
  {
    write("s.prm", text_of(good));
    cli::Options options;
    options.settings.push_back(text);
    load(what, "s.prm", options);
  }

  void
  arguments(const std::string &what, const std::vector<std::string> &list)
  {
    ++n_cases;
    std::cout << what << ": ";
    try
      {
        cli::parse_options(list);
        std::cout << "accepted\n";
      }
    catch (const core::InputError &error)
      {
        ++n_refused;
        std::cout << error.what() << '\n';
      }
  }

  void
  broken_syntax()
  {
    scene("misspelt keyword", with_line(3, "sett Type = box"));
    scene("set without a value", with_line(3, "set Type box"));
    scene("set without a name", with_line(3, "set = box"));
    scene("missing end at the end", with_line(22, ""));
    scene("missing end in the middle", with_line(5, ""));
    scene("missing end of a block", with_line(10, ""));
    scene("one end too many", and_then("end"));
    scene("text after end", with_line(5, "end of Mesh"));
    scene("subsection without a name", with_line(2, "subsection"));
    scene("backslash in the last line", and_then("set Title = a \\"));
    scene("no text", with_line(3, std::string("set Type = b\0x", 14)));
    scene("Latin-1", with_line(1, "set Title = \xE9"));
    scene("include of nothing", and_then("include nothing.prm"));
    write("a.prm", "include b.prm\n");
    write("b.prm", "\ninclude a.prm\n");
    scene("include of itself", and_then("include a.prm"));
    write("open.prm", "subsection Mesh\n");
    scene("included file without end", and_then("include open.prm"));
    scene("empty file", "");
    load("no such scene", "nothing.prm", cli::Options());
    load("a folder as scene", ".", cli::Options());
  }

  void
  unknown_names()
  {
    scene("misspelt subsection", with_line(2, "subsection Mehs"));
    scene("misspelt parameter", with_line(8, "set Youngs modulos = 1"));
    scene("parameter far from all", with_line(4, "set Colour = red"));
    scene("parameter of another section", with_line(4, "set Poisson ratio = 0.3"));
    scene("parameter outside", and_then("set Upper corner = 1, 1, 1"));
    scene("parameter outside of a block", with_line(7, "set Density = 1"));
    scene("subsection for a parameter", with_line(3, "subsection Type"));
    scene("set twice", with_line(4, "set Type = box"));
    scene("block twice",
          and_then("subsection Loads\n subsection tip\n set Type = pressure\n end\nend"));
    scene("block with a strange name", with_line(7, "subsection a/b"));
    scene("unknown law", with_line(9, "set Law = linear elastik"));
  }

  void
  wrong_values()
  {
    scene("no enumeration value", with_line(3, "set Type = boxx"));
    scene("no number", with_line(8, "set Young modulus = stiff"));
    scene("number with a unit", with_line(8, "set Young modulus = 1000 Pa"));
    scene("infinite number", with_line(8, "set Young modulus = inf"));
    scene("number too large", with_line(8, "set Young modulus = 1e999"));
    scene("two coordinates", with_line(4, "set Upper corner = 10, 1"));
    scene("no brick list", with_line(4, "set Cells = 2x2, 3x3"));
    scene("no components", with_line(14, "set Components = x, w"));
    scene("no whole number", with_line(1, "set Degree = 1.5"));
    scene("degree 3", with_line(1, "set Degree = 3"));
    scene("two values", with_line(20, "set Value = 0; 1"));
  }

  void
  formulation()
  {
    const auto mixed = [](const unsigned int number, const std::string &text) {
      auto lines        = good;
      lines[0]          = "set Degree = 2\nset Formulation = mixed";
      lines[number - 1] = number == 1 ? text : text + "\n";
      return text_of(lines);
    };
    scene("mixed, degree 1", with_line(1, "set Formulation = mixed"));
    scene("mixed, nu = 0", mixed(9, "set Poisson ratio = 0"));
    scene("displacement, nu = 0.499999", with_line(9, "set Poisson ratio = 0.499999"));
    scene("mixed, equilibrated",
          mixed(22, "end\nsubsection Estimation\nset Estimators = equilibrated\nend"));
    scene("mixed, hexahedra", mixed(22, "end\nsubsection Reference\nset Type = hexahedra\nend"));
    scene("mixed, goal of stress",
          mixed(22,
                "end\nsubsection Goals\nsubsection s\nset Type = mean stress\nset Component = "
                "xx\nend\nend"));
  }

  void
  nonsense_physics()
  {
    scene("nu = 0.5", with_line(9, "set Poisson ratio = 0.5"));
    scene("nu = -1", with_line(9, "set Poisson ratio = -1"));
    scene("E = 0", with_line(8, "set Young modulus = 0"));
    scene("negative density", with_line(9, "set Density = -1"));
    scene("gravity without density", with_line(19, "set Type = gravity"));
    scene("pressure with three values", with_line(19, "set Type = pressure"));
    scene("traction on a region", with_line(19, "set Regions = 1"));
    scene("body force on faces", with_line(18, "subsection tip\nset Type = body force"));
    scene("no material", "subsection Supports\nsubsection a\nend\nend");
    scene("no support",
          "subsection Materials\nsubsection a\nend\nend\nsubsection Loads\nsubsection b\nset "
          "Groups = x-max\nset Value = 0; 0; 1\nend\nend");
    scene("free in y", with_line(14, "set Where = x < 1e-9\nset Components = x, z"));
    scene("no load", with_line(20, "set Value = 0; 0; 0"));
    scene("two materials everywhere", with_line(10, "end\nsubsection fat\nend"));
    scene("region twice",
          with_line(10, "set Regions = 1, 2\nend\nsubsection fat\nset Regions = 2\nend"));
    scene("contradictory supports",
          with_line(15,
                    "end\nsubsection pull\nset Where = x < 1e-9\nset Displacement = 0; 0; 1\nend"));
    scene("displacement of a free component",
          with_line(14, "set Where = x < 1e-9\nset Components = x, y\nset Displacement = 0; 0; 1"));
    scene("predicate that never holds", with_line(14, "set Where = 1 > 2"));
  }

  /** What holds somewhere else than was meant. */
  void
  bad_conditions()
  {
    scene("assignment", with_line(14, "set Where = x = 0.5"));
    scene("assignment to what is none", with_line(14, "set Where = y < 1 && (2*x - y) = 0.5"));
    scene("assignment in a value", with_line(20, "set Value = 0; 0; if(z = 1, 1, 0)"));
    scene("assignment without a side", with_line(14, "set Where = x =< 0.5"));
    scene("chained comparison", with_line(14, "set Where = x < 1 && 0.2 <= y < 0.75"));
    scene("chained comparison in a value", with_line(20, "set Value = 0; 0; if(0.1<y<0.9, -1, 0)"));
    scene("comparison of truths", with_line(14, "set Where = (x < 1) == (y < 0.5) && x <= 2"));
    scene("support nowhere", with_line(14, "set Components = all"));
    scene("load nowhere", with_line(19, "set Type = traction"));
    scene("pressure everywhere",
          with_line(19,
                    "set Type = pressure\nset Where = everywhere\nset Value = 2\nend\nsubsection b"
                    "\nset Groups = x-max"));
    scene("everywhere and a group", with_line(19, "set Groups = x-max\nset Where = everywhere"));
    scene("body force everywhere",
          with_line(18,
                    "subsection tip\nset Type = body force\nset Where = everywhere\nend\n"
                    "subsection b"));
    scene("mean displacement nowhere",
          and_then("subsection Goals\nsubsection g\nset Type = mean displacement\nend\nend"));
    scene("traction weight nowhere",
          and_then("subsection Goals\nsubsection g\nset Type = functional\nset Traction weight = "
                   "1; 0; 0\nend\nend"));
    scene("time in a load", with_line(20, "set Value = 0; 0; -sin(2*t)"));
    scene("time in a condition", with_line(14, "set Where = x < 0.1 + t"));
    scene("time in a support", with_line(14, "set Where = x < 1e-9\nset Displacement = 0; t; 0"));
    scene("time in a size", with_line(3, "set Size = 1 + t"));
    scene("time in a goal",
          and_then(
            "subsection Goals\nsubsection g\nset Type = mean stress\nset Component = xx\nset "
            "Weight = 1 + t\nend\nend"));
    scene("time in the exact solution",
          and_then("subsection Exact solution\nset Displacement = x; t*y; 0\nend"));
    scene("a name that begins with t", with_line(20, "set Value = 0; 0; -tanh(y)"));
  }

  void
  bad_expressions()
  {
    scene("unknown variable", with_line(14, "set Where = r < 1"));
    scene("missing parenthesis", with_line(20, "set Value = 0; 0; sin(x"));
    scene("comma for semicolon", with_line(20, "set Value = 0, 0, 1"));
    scene("empty component", with_line(20, "set Value = 0;; 1"));
    scene("constant without value", with_line(20, "set Value = 0; 0; 1/0"));
    scene("negative size", with_line(3, "set Size = -1"));
    scene(
      "wrong exact gradient",
      and_then(
        "subsection Exact solution\nset Displacement = x*y; 0; 0\nset Gradient = y; y; 0; 0; 0; "
        "0; 0; 0; 0\nend"));
    scene("gradient without displacement",
          and_then("subsection Exact solution\nset Gradient = 0;0;0;0;0;0;0;0;0\nend"));
  }

  void
  bad_meshes()
  {
    scene("inverted box", with_line(4, "set Upper corner = -10, 1, 1"));
    scene("flat box", with_line(4, "set Upper corner = 10, 1, 1e-6"));
    scene("zero bricks", with_line(3, "set Type = bricks\nset Cells = 2x0x2"));
    scene("too many bricks", with_line(3, "set Type = bricks\nset Cells = 9999x9999x9999"));
    scene("surface without a file", with_line(3, "set Type = surface"));
    scene("missing mesh file", with_line(3, "set Type = file\nset Files = no.msh"));
    scene("missing femur", with_line(3, "set Type = surface\nset Files = .cache/data/femur.off"));
    scene("mesh file of another format", with_line(3, "set Type = file\nset Files = no.step"));
    write("empty.msh", "");
    scene("empty mesh file", with_line(3, "set Type = file\nset Files = empty.msh"));
    write("half.node", "0 3 0 0\n");
    scene("node file without ele file", with_line(3, "set Type = file\nset Files = half.node"));
    scene("negative volume", with_line(3, "set Volume bound = -1"));
    scene("volume bound for bricks", with_line(3, "set Type = bricks\nset Volume bound = 1"));
    scene("q = 1", and_then("subsection TetGen\nset Radius-edge ratio = 1\nend"));
    scene("dihedral angle of 70",
          and_then("subsection TetGen\nset Minimum dihedral angle = 70\nend"));
    scene("no time for TetGen", and_then("subsection TetGen\nset Time limit = 0\nend"));
  }

  void
  bad_studies()
  {
    scene("tolerance 0", and_then("subsection Solver\nset Tolerance = 0\nend"));
    scene("negative energy", and_then("subsection Exact solution\nset Strain energy = -4\nend"));
    scene("reference of unknown fineness",
          and_then("subsection Reference\nset Type = fine mesh\nend"));
    scene("reference run without a file",
          and_then("subsection Reference\nset Type = earlier run\nend"));
    scene("indicator without a reference",
          and_then("subsection Adaptivity\nset Strategy = adaptive\nend"));
    scene(
      "exact indicator without exact solution",
      and_then(
        "subsection Adaptivity\nset Strategy = adaptive\nset Refinement indicator = exact\nend"));
    scene("mesh list of one", and_then("subsection Adaptivity\nset Strategy = mesh list\nend"));
    scene("several meshes, no list", with_line(3, "set Volume bound = 1, 0.1"));
    scene("tolerance that cannot be measured",
          and_then("subsection Adaptivity\nset Tolerance = 0.1\nend"));
    scene("growth below 1", and_then("subsection Adaptivity\nset Growth = 0.5\nend"));
    scene("theta = 0", and_then("subsection Adaptivity\nset Theta = 0\nend"));
    scene("output to a file", and_then("subsection Output\nset Directory = s.prm\nend"));
  }

  /** The good scene with a study of two blocks, from line 23 on. */
  void
  variations(const std::string &what,
             const std::string &parameters,
             const std::string &values,
             const std::string &more   = "",
             const std::string &second = "TetGen/Radius-edge ratio")
  {
    scene(what,
          and_then("subsection Study\n subsection a\n  set Parameters = " + parameters
                   + "\n  set Values = " + values + "\n" + more
                   + " end\n subsection b\n  set Parameters = " + second
                   + "\n  set Values = 1.2 | 2\n end\nend"));
  }

  void
  bad_variations()
  {
    variations("study", "Degree", "1 | 2");
    variations("study with strange labels",
               "Loads/tip/Value & Degree",
               "0; 0; 1 & 1 | 0; 1; 0 & 2",
               "  set Labels = ../../etc | \xC3\xA9 / 'x'\n");
    variations("study of nothing", "", "1");
    variations("study without values", "Degree", "");
    variations("study of an unknown parameter", "Degre", "1 | 2");
    variations("study of an unknown section", "Tetgen/Radius-edge ratio", "1 | 2");
    variations("study of an unknown block", "Loads/tipp/Value", "0; 0; 1");
    variations("study of a section", "Loads/tip", "0; 0; 1");
    variations("study of half a name", "Loads//Value", "0; 0; 1");
    variations("study of a study", "Study/b/Values", "3");
    variations("study of a value that does not fit", "Degree", "1 | two");
    variations("study of a value that makes no sense", "Degree", "1 | 3");
    variations("study of too few values", "Degree & TetGen/Keep boundary", "1 & yes | 2");
    variations("study of two that fit in no combination",
               "TetGen/Minimum dihedral angle",
               "10 | 70");
    variations("study that varies one thing twice", "Degree", "1 | 2", "", "Degree");
    variations("study with a label too few", "Degree", "1 | 2", "  set Labels = one\n");
    variations("study of too many runs", "TetGen/Time limit", []() {
      std::string values = "1";
      for (unsigned int i = 2; i < 600; ++i)
        values += " | " + std::to_string(i);
      return values;
    }());
    write("inner.prm",
          text_of(good)
            + "subsection Study\n subsection a\n  set Parameters = Degree\n"
              "  set Values = 1 | 2\n end\nend\n");
    scene("study of an included file, changed",
          "include inner.prm\nsubsection Study\n subsection a\n"
          "  set Values = 2 | 5\n end\nend\n");
  }

  /** Several mistakes in one file: each is told, in the order of the lines, and nothing that
   * only follows from one. */
  void
  many_mistakes()
  {
    scene(
      "names, values and checks",
      "set Degre = 1\n"
      "subsection Mesh\n set Type = box\n set Upper corner = 10, 1\nend\n"
      "subsection Materials\n subsection bone\n  set Young modulus = stiff\n  set Poisson ratio "
      "= 0.7\n  set Density = -2\n end\nend\n"
      "subsection Supports\n subsection foot\n  set Where = x = 0\n end\n subsection hand\n  set "
      "Wher = x > 9\n end\nend\n"
      "subsection Load\n subsection tip\n  set Value = 0; 0; -1\n end\nend\n"
      "subsection Solver\n set Tolerance = 2\n set Maximum iterations = 0\nend\n");
    scene("parameters of an earlier version",
          and_then("subsection Truth\n set Energy = 1\nend\nsubsection Adaptivity\n set Driver = "
                   "spr\n set Route = size\n set Growth = 0.5\nend"));
    scene("two lines that are none",
          with_line(5,
                    "end\nand so on\nset Title\nsubsection Estimation\nset Estimator = spr\nend"));
    scene("a mistake and a missing end", with_line(8, "set Young modulos = 7\nend"));
    write("wrong.prm", "subsection TetGen\n set Radius-edge ratio = 1\n set Tetrahedra = 7\nend\n");
    scene("a mistake in an included file",
          "include wrong.prm\n" + with_line(9, "set Density = -1"));
    scene("a missing file and a mistake",
          "include wrongs.prm\n" + with_line(9, "set Densitie = 1"));
    scene("a study with mistakes in several runs",
          and_then(
            "subsection Study\n subsection a\n  set Parameters = Degree & Materials/bone/Poisson "
            "ratio\n  set Values = 1 & 0.3 | 3 & 0.4 | 2 & 0.6\n end\nend"));
    std::string lines;
    for (unsigned int i = 0; i < 32; ++i)
      lines += "A letter, line " + std::to_string(i) + "\n";
    scene("a text", lines);
  }

  void
  bad_command_lines()
  {
    setting("setting without =", "Degree");
    setting("setting of an unknown section", "Solvr/Tolerance=1");
    setting("setting of an unknown parameter", "Solver/Tolerence=1");
    setting("setting of an unknown block", "Loads/tipp/Value=0; 0; 1");
    setting("setting that does not fit", "Degree=two");
    setting("setting that makes no sense", "Materials/bone/Young modulus=-1");
    arguments("unknown option", {"--validat", "s.prm"});
    arguments("option without its value", {"s.prm", "--set"});
    arguments("switch with a value", {"--quiet=yes", "s.prm"});
    arguments("unknown format", {"--print-parameters=jsn"});
    arguments("no scene", {"--quiet"});
  }
} // namespace

int
main()
{
  scene("the good scene", text_of(good));
  broken_syntax();
  unknown_names();
  wrong_values();
  nonsense_physics();
  formulation();
  bad_conditions();
  bad_expressions();
  bad_meshes();
  bad_studies();
  bad_variations();
  many_mistakes();
  bad_command_lines();
  std::cout << n_refused << " of " << n_cases << " refused\n";
}
