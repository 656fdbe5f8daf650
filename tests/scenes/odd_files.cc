// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Files that are none, and names and texts that could do harm where they are printed.

#include "program.h"

#include <sys/stat.h>

#include <chrono>

using namespace program;

namespace
{
  const std::string rest = loaded_block("0; 1; -2"), cube = bricks_section("2x2x2");

  /** Runs with a limit of time: nothing may wait for a pipe. */
  Result
  run_shortly(const std::string &arguments)
  {
    return run("--validate --quiet " + arguments, "timeout 60");
  }

  /** @p file as a scene and a mesh, or as whatever a scene can name. */
  void
  as_input(const std::string &what, const std::string &file, const bool in_all_places = false)
  {
    std::cout << what << ":";
    const auto as = [&](const std::string &ending) {
      const std::string name = "f" + ending;
      fs::remove(name);
      fs::create_symlink(file, name);
      return name;
    };
    const auto code = [&](const std::string &content) {
      write("uses.prm", content);
      const Result result = run_shortly("uses.prm");
      std::cout << ' ' << result.code
                << (contains(result.err, "Error: ") && !contains(result.err, "unexpected") ? ""
                                                                                           : "?");
    };
    const Result scene = run_shortly(as(".prm"));
    std::cout << ' ' << scene.code;
    code("subsection Mesh\n set Type = file\n set Files = " + as(".msh") + "\nend\n" + rest);
    if (in_all_places)
      {
        code("include f.prm\n" + cube + rest);
        code("subsection Mesh\n set Type = surface\n set Files = " + as(".stl") + "\nend\n" + rest);
        code("subsection Mesh\n set Type = box\n set Size field = " + as(".vtu") + "\nend\n"
             + rest);
        code(cube + rest + "subsection Reference\n set Type = run\n set File = f.vtu\nend\n");
      }
    std::cout << std::endl;
  }

  void
  no_files()
  {
    mkfifo("fifo", 0666);
    fs::create_symlink("loop", "loop");
    fs::create_directory("folder");
    write("zeros", std::string(3u << 20, '\0'));
    write("letters", std::string(3u << 20, 'x'));
    as_input("a pipe", "fifo", true);
    as_input("a device", "/dev/zero");
    as_input("a circle of links", "loop");
    as_input("a folder", "folder");
    as_input("zeros without a line end", "zeros");
    as_input("letters without a line end", "letters");
    const std::string name(300, 'n'), path = "a/" + std::string(5000, '/') + "b";
    std::cout << "names that are too long: " << run_shortly(name + ".prm").code << ' '
              << run_shortly("folder/" + path + ".prm").code << ' ';
    write("uses.prm", "include " + name + ".prm\n");
    std::cout << run_shortly("uses.prm").code << ' ';
    write("uses.prm",
          "subsection Mesh\n set Type = surface\n set Files = " + name + ".off\nend\n" + rest);
    std::cout << run_shortly("uses.prm").code << ' ';
    write("s.prm", cube + rest);
    std::cout << run("--quiet --output-directory " + name + " s.prm").code << ' '
              << run("--quiet --output-directory loop s.prm").code << ' '
              << run("--quiet --output-directory loop/below s.prm").code << std::endl;
    std::cout << "a text of 200 kB: ";
    const std::string text(200000, 'y');
    for (const std::string line : {"set " + text + " = 1\n",
                                   "subsection " + text + "\nend\n",
                                   text + "\n",
                                   "set Degree = " + text + "\n"})
      {
        write("uses.prm", line);
        const Result result = run_shortly("uses.prm");
        std::cout << result.code << (result.err.size() < 5000 ? " " : " LONG ");
      }
    write("uses.prm", cube + rest);
    const Result load
      = run_shortly("--set 'Loads/l/Value=0; 0; " + text.substr(0, 100000) + "' uses.prm");
    std::cout << load.code << (load.err.size() < 5000 ? "" : " LONG") << std::endl;
  }

  /** Whether a terminal could take a byte for a command. */
  bool
  is_harmless(const std::string &text)
  {
    return std::all_of(text.begin(), text.end(), [](const unsigned char c) {
      return (c >= 32 && c != 127) || c == '\n' || c == '\t';
    });
  }

  void
  names()
  {
    // A mesh with groups whose names are escape sequences.
    const std::string evil = "\x1b]0;owned\x07\x7f\x1b[2J";
    write(
      "evil.msh",
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n2 1 \"" + evil
        + "\"\n2 3 \"top\"\n3 2 \"body\"\n$EndPhysicalNames\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 "
          "0\n4 0 0 1\n$EndNodes\n$Elements\n3\n1 2 2 1 1 1 2 3\n2 2 2 3 3 2 3 4\n3 4 2 2 2 1 2 "
          "3 4\n$EndElements\n");
    write("evil.prm", "subsection Mesh\n set Type = file\n set Files = evil.msh\nend\n" + rest);
    const Result result = run("--quiet --output-directory out evil.prm");
    check("names of groups are cleaned",
          result.code == 2 && contains(result.err, "\\x1b") && is_harmless(result.err)
            && is_harmless(read("out/log.txt")));
    const std::string name = "a\x1b[31mb\x7f.prm";
    write(name, cube + rest);
    const int status = std::system(
      ("bash -c \"'" + binary() + "' --output-directory named a?*b?.prm\" >out.txt 2>err.txt")
        .c_str());
    check("the file's own name",
          status == 0 && is_harmless(read("err.txt")) && is_harmless(read("out.txt"))
            && is_harmless(read("named/log.txt")) && contains(read("named/log.txt"), "\\x1b"));
  }

  void
  tables_and_plots()
  {
    write("study.prm",
          cube + rest
            + "subsection Output\n set VTU = no\nend\n"
              "subsection Study\n subsection f\n  set Parameters = Loads/l/Value\n  set Values = "
              "-1; 0; 0 | 0; 0; 3\n  set Labels = =1+1 | @cmd, x\n end\nend\n");
    const Result study = run("--quiet --output-directory study study.prm");
    const auto   csv   = read("study/study.csv");
    std::cout << "study: " << study.code << study.err << std::endl;
    check("labels are no formulas", contains(csv, ",'=1+1,") && contains(csv, ",\"'@cmd, x\","));
    check("nor is a value that is none", contains(csv, ",'-1; 0; 0,"));
    write("title.prm",
          "set Title = It's 5 o'clock: the bar''s \"end\"\n" + cube + rest
            + "subsection Adaptivity\n set Strategy = uniform\n set Maximum cycles = 3\nend\n"
              "subsection Output\n set Plots = yes\nend\nsubsection Estimation\n set Estimators = "
              "spr\nend\n");
    const Result title     = run("--output-directory title title.prm");
    unsigned int n_scripts = 0, n_pictures = 0;
    for (const auto &entry : fs::directory_iterator("title/plots"))
      {
        n_scripts += entry.path().extension() == ".gp";
        n_pictures += entry.path().extension() == ".svg";
      }
    const bool has_gnuplot = !contains(title.err, "gnuplot is missing");
    check("a title with an apostrophe loses no plot",
          title.code == 0 && n_scripts > 0 && n_pictures == (has_gnuplot ? n_scripts : 0));
    write("gnuplot", "#!/bin/sh\ntouch was_run\n");
    fs::permissions("gnuplot", fs::perms::owner_all);
    run("--quiet --output-directory title title.prm", "PATH=:/nowhere: ");
    check("no program of the working directory is run", !fs::exists("was_run"));
  }
} // namespace

int
main()
{
  no_files();
  names();
  tables_and_plots();
}
