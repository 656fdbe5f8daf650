// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Scenes that are refused when their meshes are made, or later: each with its exit
// code and the message that a user gets. None may crash, hang or give a number.

#include "program.h"

using namespace program;

namespace
{
  struct Case
  {
    std::string name, text;
    /** For messages that tests/geometry has; they partly come from CGAL. */
    bool brief = false;
  };
  std::vector<Case> cases;

  const std::string model = R"(
subsection Materials
  subsection m
  end
end
subsection Supports
  subsection foot
    set Where = z < 1e-9
  end
end
subsection Loads
  subsection push
    set Type  = body force
    set Value = 1; 0; 0
  end
end
)";

  /** A scene on a mesh file of the given content. */
  void
  file(const std::string &name,
       const std::string &ending,
       const std::string &content,
       bool               surface = false)
  {
    const std::string stem = "m" + std::to_string(cases.size());
    write(stem + "." + ending, content);
    cases.push_back({name,
                     "subsection Mesh\n set Type = " + std::string(surface ? "surface" : "file")
                       + "\n set Files = " + stem + "." + ending + "\nend\n" + model,
                     surface});
  }

  void
  surface(const std::string &name, const std::string &ending, const std::string &content)
  {
    file(name, ending, content, true);
  }

  /** A pair of .node and .ele files. */
  void
  node_ele(const std::string &name, const std::string &nodes, const std::string &cells)
  {
    write("m" + std::to_string(cases.size()) + ".ele", cells);
    file(name, "node", nodes);
  }

  /** The model on bricks with other text in place of some of its own. */
  void
  bricks(const std::string &name, const std::string &old_text, const std::string &new_text)
  {
    std::string text = "subsection Mesh\n set Type = bricks\n set Cells = 2x2x2\nend\n" + model;
    text.replace(text.find(old_text), old_text.size(), new_text);
    cases.push_back({name, text});
  }

  const std::string head  = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n",
                    nodes = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n";

  void
  volume_files()
  {
    file("msh: cut off in the nodes", "msh", head + "$Nodes\n4\n1 0 0 0\n2 1 0");
    file("msh: cut off before the elements", "msh", head + nodes);
    file("msh: unknown version", "msh", "$MeshFormat\n9.9 0 8\n$EndMeshFormat\n" + nodes);
    file("msh: no number", "msh", head + "$Nodes\n4\n1 0 0 zero\n");
    file("msh: not a number", "msh", head + "$Nodes\n4\n1 0 0 nan\n");
    file("msh: too many nodes to be true", "msh", head + "$Nodes\n99999999999\n1 0 0 0\n");
    file("msh: unknown node",
         "msh",
         head + nodes + "$Elements\n1\n1 4 2 0 1 1 2 3 9\n$EndElements\n");
    file("msh: hexahedron",
         "msh",
         head + nodes + "$Elements\n1\n1 5 2 0 1 1 2 3 4 1 2 3 4\n$EndElements\n");
    file("msh: only triangles",
         "msh",
         head + nodes + "$Elements\n1\n1 2 2 0 1 1 2 3\n$EndElements\n");
    file("vtk: not VTK", "vtk", "hello\n");
    file(
      "vtk: cut off",
      "vtk",
      "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n0 0 0\n");
    file("vtu: not XML", "vtu", "<VTKFile type=\"Unstr");
    file("vtu: another type",
         "vtu",
         "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\"></VTKFile>\n");
    node_ele("node: fewer nodes than promised",
             "4 3 0 0\n0 0 0 0\n1 1 0 0\n",
             "1 4 0\n0 0 1 2 3\n");
    node_ele("node: infinite",
             "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 inf\n",
             "1 4 0\n0 0 1 2 3\n");
    const std::string four = "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n";
    node_ele("node: flat tetrahedron",
             "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 1 1 0\n",
             "1 4 0\n0 0 1 2 3\n");
    node_ele("ele: a node twice", four, "1 4 0\n0 0 1 2 2\n");
    node_ele("ele: unknown node", four, "1 4 0\n0 0 1 2 4\n");
    node_ele("ele: no tetrahedra", four, "0 4 0\n");
    node_ele("ele: the same tetrahedron twice", four, "2 4 0\n0 0 1 2 3\n1 0 1 2 3\n");
    node_ele("ele: one inside another",
             "5 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 0.1 0.1 0.5\n",
             "2 4 0\n0 0 1 2 3\n1 0 1 2 4\n");
    node_ele("node: the same point twice",
             "5 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 1 0 0\n",
             "2 4 0\n0 0 1 2 3\n1 0 4 2 3\n");
  }

  void
  surface_files()
  {
    const std::string points = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
    surface("off: open", "off", "OFF\n4 3 0\n" + points + "3 0 2 1\n3 0 1 3\n3 0 3 2\n");
    surface("off: unknown point",
            "off",
            "OFF\n4 4 0\n" + points + "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 7\n");
    surface("off: cut off", "off", "OFF\n4 4 0\n" + points + "3 0 2 1\n3 0 1\n");
    surface("off: not a number",
            "off",
            "OFF\n4 4 0\n0 0 nan\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
    surface("off: flat",
            "off",
            "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
    surface("off: two that cross",
            "off",
            "OFF\n8 8 0\n" + points
              + "0.1 0.1 0.1\n1.1 0.1 0.1\n0.1 1.1 0.1\n0.1 0.1 1.1\n"
                "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n3 4 6 5\n3 4 5 7\n3 4 7 6\n3 5 6 7\n");
    surface("off: empty", "off", "OFF\n0 0 0\n");
    surface(
      "stl: open",
      "stl",
      "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
      "endfacet\nendsolid s\n");
    surface("stl: cut off",
            "stl",
            "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0");
    surface("ply: cut off",
            "ply",
            "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty "
            "float z\n"
            "element face 4\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n");
    surface("obj: no faces", "obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n");
    surface("volume mesh as a surface", "msh", head + nodes);
  }

  void
  places()
  {
    bricks("support: nowhere", "z < 1e-9", "z > 2");
    bricks("support: inside only", "z < 1e-9", "abs(z - 0.5) < 1e-9");
    bricks("support: unknown group", "Where = z < 1e-9", "Groups = bottom");
    bricks("support: unknown id", "Where = z < 1e-9", "Boundary ids = 77");
    bricks("support: hinge",
           "set Where = z < 1e-9",
           "set Where = z < 1e-9\n set Components = z\n end\n subsection a\n set Groups = y-min\n "
           "set Components = x\n end\n"
           "subsection b\n set Groups = x-min\n set Components = y");
    bricks("supports: contradiction",
           "set Where = z < 1e-9",
           "set Where = z < 1e-9\n end\n subsection side\n set Groups = x-max\n set Displacement = "
           "0; 0; 1-z");
    bricks("support: value without bounds",
           "set Where = z < 1e-9",
           "set Where = z < 1e-9\n set Displacement = 1/x; 0; 0");
    bricks("material: unknown region", "subsection m\n", "subsection m\n set Regions = 3\n");
    bricks("material: unknown group",
           "subsection m\n",
           "subsection m\n set Region groups = bone\n");
    bricks("load: unknown region", "set Value = 1; 0; 0", "set Value = 1; 0; 0\n set Regions = 5");
    bricks("load: not finite", "set Value = 1; 0; 0", "set Value = 0; 0; sqrt(x - 0.5)");
    bricks("load: nowhere", "set Type  = body force", "set Where = x > 5");
  }

  void
  references()
  {
    const std::string base = "subsection Mesh\n set Type = bricks\n set Cells = 2x2x2\nend\n"
                             + model + "subsection Reference\n";
    const auto earlier = [&](const std::string &name, const std::string &content) {
      const std::string vtu = "r" + std::to_string(cases.size()) + ".vtu";
      write(vtu, content);
      cases.push_back({name, base + " set Type = earlier run\n set File = " + vtu + "\nend\n"});
    };
    write("good.prm", "subsection Mesh\n set Type = bricks\nend\n" + model);
    run("--quiet --output-directory good good.prm");
    const std::string vtu = read("good/cycle_000.vtu");
    earlier("reference: cut off", vtu.substr(0, vtu.size() / 2));
    std::string other = vtu;
    for (auto at = other.find("displacement"); at != std::string::npos;
         at      = other.find("displacement"))
      other.replace(at, 12, "velocity");
    earlier("reference: without a displacement", other);
    cases.push_back({"reference: mesh file is broken",
                     base + " set Type = fine mesh\n set Mesh = file\n set File = m0.msh\nend\n"});
    cases.push_back(
      {"reference: negative size",
       "subsection Mesh\nend\n" + model
         + "subsection Reference\n set Type = fine mesh\n set Size = x - 0.5\nend\n"});
    cases.push_back(
      {"reference: no number as size",
       "subsection Mesh\nend\n" + model
         + "subsection Reference\n set Type = fine mesh\n set Size = sqrt(x - 0.5)\nend\n"});
  }
} // namespace

int
main()
{
  volume_files();
  surface_files();
  places();
  references();
  std::string list;
  for (unsigned int i = 0; i < cases.size(); ++i)
    {
      const std::string name = "s" + std::to_string(i) + ".prm";
      write(name, cases[i].text);
      list += " " + name;
    }
  // One process, so that it also shows that none harms the next.
  const auto         result = run("--quiet --output-directory " + fresh("out").string() + list);
  std::istringstream lines(portable(result.err));
  std::vector<std::string> messages;
  for (std::string line; std::getline(lines, line);)
    if (line.compare(0, 7, "Error: ") == 0)
      messages.push_back(line.substr(7));
    else if (line.compare(0, 8, "Warning:") != 0 && !messages.empty())
      messages.back() += " | " + line;
  std::cout << "exit code " << result.code << ", " << cases.size() << " scenes, " << messages.size()
            << " errors" << std::endl;
  for (unsigned int i = 0; i < std::min(cases.size(), messages.size()); ++i)
    {
      std::cout << cases[i].name << ": ";
      if (!cases[i].brief)
        std::cout << messages[i] << std::endl;
      else if (contains(messages[i], "m" + std::to_string(i) + "."))
        std::cout << "refused, with its name" << std::endl;
      else
        std::cout << "NOT NAMED: " << messages[i] << std::endl;
    }
  unsigned int n_partial = 0;
  for (unsigned int i = 0; i < cases.size(); ++i)
    {
      const std::string left = files("out/s" + std::to_string(i));
      n_partial += !left.empty() && left != "log.txt parameters.prm";
    }
  std::cout << n_partial << " left results behind" << std::endl;
}
