// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The reference on disk: reused when nothing that determines it changed, made from scratch
// when something did or when the file is damaged, always with the same figures.

#include "program.h"

using namespace program;

namespace
{
  const std::string prm = R"(
subsection Mesh
  set Type  = file
  set Files = body.node
end
subsection Materials
  subsection m
    set Young modulus = 1000
  end
end
subsection Supports
  subsection s
    set Where = z < 1e-9
  end
end
subsection Loads
  subsection l
    set Type  = body force
    set Value = 1; 0; 0
  end
end
subsection Reference
  set Type            = fine mesh
  set Size            = 0.3
  set Cache directory = kept
end
)";

  /** A tetrahedron with its top at height @p z. */
  void
  write_body(const std::string &z)
  {
    write("body.node", "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 " + z + "\n");
    write("body.ele", "1 4 0\n0 0 1 2 3\n");
  }

  std::string
  cached_files()
  {
    return files("kept");
  }

  unsigned int
  n_cached()
  {
    const std::string text = cached_files();
    return text.empty() ? 0 : 1 + std::count(text.begin(), text.end(), ' ');
  }

  Table
  go(const std::string &what, const std::string &settings = "")
  {
    const auto result
      = run("--quiet --output-directory " + fresh("out").string() + " " + settings + " s.prm");
    const std::string log = read("out/log.txt");
    std::cout << what << ": exit code " << result.code << ", "
              << (contains(log, "Reference: reused from") ? "reused" : "solved") << ", "
              << n_cached() << " kept";
    if (contains(log, "cannot be used"))
      std::cout << ", warned";
    std::cout << std::endl;
    return Table("out");
  }
} // namespace

int
main()
{
  fresh("kept");
  write("s.prm", prm);
  write_body("1");
  const Table       first  = go("first run");
  const std::string name   = cached_files();
  const Table       second = go("second run");
  check("  the same figures", first.distance(second) < 1e-14);
  const std::string file = "kept/" + name, whole = read(file);

  std::string damaged = whole;
  damaged[damaged.size() / 2] ^= 1;
  write(file, damaged);
  const Table repaired = go("one bit flipped");
  check("  the same figures", first.distance(repaired) < 1e-9);
  check("  the file is whole again", read(file).size() == whole.size());
  go("and again");
  write(file, whole.substr(0, whole.size() - 7));
  go("cut off");
  write(file, "");
  go("empty");
  write(file, whole + "x");
  go("too long");
  check("  the file is whole again", read(file).size() == whole.size());

  go("another output folder's name and title", "--set Title=other --set Output/VTU=no");
  go("another way of adapting",
     "--set Adaptivity/Strategy=uniform --set 'Adaptivity/Maximum cycles=2'");
  go("another degree of the scene", "--set Degree=2");
  go("another stiffness", "--set 'Materials/m/Young modulus=2000'");
  go("another load", "--set 'Loads/l/Value=2; 0; 0'");
  go("another size", "--set Reference/Size=0.25");
  go("another degree of the reference", "--set Reference/Degree=1");
  write_body("1.0");
  go("the same mesh, written otherwise");
  write_body("1.5");
  go("another mesh under the same name");
  write_body("1");
  go("the first mesh again");
  go("without the cache", "--set Reference/Cache=no");
  go("where nothing can be kept", "--set 'Reference/Cache directory=s.prm'");
}
