// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Total forces and rotations in whole runs: exact in every cycle, also on projected walls; for all
// estimators and references the same as tractions and body forces that say it with expressions;
// and what is refused.

#include "program.h"

using namespace program;

namespace
{
  struct Row
  {
    std::string         kind, name;
    std::vector<double> figures; ///< force, then moment about the origin
  };

  /** The supports and loads of all cycles. */
  std::vector<Row>
  rows_of(const fs::path &folder)
  {
    std::ifstream    file(folder / "reactions.csv");
    std::string      line;
    std::vector<Row> rows;
    std::getline(file, line);
    while (std::getline(file, line))
      {
        std::istringstream       cells(line);
        std::vector<std::string> texts;
        for (std::string cell; std::getline(cells, cell, ',');)
          texts.push_back(cell);
        Row row{texts.at(1), texts.at(2), {}};
        for (unsigned int i = 8; i < 14; ++i)
          row.figures.push_back(std::strtod(texts.at(i).c_str(), nullptr));
        rows.push_back(row);
      }
    return rows;
  }

  /** Whether the load has this force and this moment about the origin in at least @p n_cycles
   * cycles, and in all; fewer numbers are the force alone. */
  void
  check_load(const std::string         &what,
             const fs::path            &folder,
             const std::string         &name,
             const std::vector<double> &exact,
             const unsigned int         n_cycles,
             const std::string         &kind = "")
  {
    unsigned int n     = 0;
    double       worst = 0., size = 0.;
    for (const Row &row : rows_of(folder))
      if (row.name == name && (kind.empty() || row.kind == kind))
        {
          ++n;
          for (unsigned int i = 0; i < exact.size(); ++i)
            {
              worst = std::max(worst, std::abs(row.figures[i] - exact[i]));
              size  = std::max(size, std::abs(exact[i]));
            }
        }
    const bool good = n >= n_cycles && worst <= 1e-10 * size;
    check(what, good);
    if (!good)
      std::cout << "  " << n << " cycles, differs by " << worst << std::endl;
  }

  Table
  run_scene(const std::string &name, const std::string &text, const std::string &options)
  {
    write(name + ".prm", text);
    const fs::path folder = fresh(name);
    const auto     result
      = run("--quiet --output-directory " + name + " " + options + " " + name + ".prm");
    std::cout << name << ": exit code " << result.code << '\n'
              << (result.code == 0 ? "" : result.err);
    return Table(folder);
  }

  std::string
  block(const std::string &name, const std::string &settings)
  {
    return "subsection " + name + "\n" + settings + "\nend\n";
  }

  const std::string output = block("Output", "set VTU = no") + block("Reference", "set Cache = no");

  /** A quarter of a lug around a pin of radius 1; the other radius is 2. */
  std::string
  lug(const std::string &load)
  {
    const std::string meshes = fs::path(SOURCE_DIR).parent_path().parent_path() / "meshes";
    return block(
             "Mesh",
             "set Type = file\nset Files = " + meshes
               + "/cylinder_quarter.msh\nset Projection = expression\nset Projection functions = "
                 "x^2 + y^2 - 1; x^2 + y^2 - 4")
           + block("Materials", block("m", "set Young modulus = 1000\nset Poisson ratio = 0.3"))
           + block("Supports", block("foot", "set Groups = x-min, y-min"))
           + block("Loads", block("l", load))
           + block("Adaptivity",
                   "set Strategy = adaptive\nset Refinement indicator = spr\nset Maximum cycles = "
                   "5\nset Growth = 3\nset Maximum tetrahedra = 8000")
           + block("Solver", "set Tolerance = 1e-12") + output;
  }

  void
  within(const std::string &what, const double value, const double lower, const double upper)
  {
    const bool good = value >= lower && value <= upper;
    check("  " + what + " agrees with spr", good);
    if (!good)
      std::cout << "  " << value << std::endl;
  }

  void
  projected()
  {
    const std::string pin  = "set Type = total force\nset Groups = inner\nset Value = 1; 1; "
                             "0\nset Distribution = bearing";
    const std::string slab = "set Type = total force\nset Groups = outer\nset Value = 1; -2; "
                             "0.5\nset Moment = 0.5; 2; -1\nset About = 0, 0, 3";
    for (const std::string degree : {"1", "2"})
      {
        const std::string options
          = "--set Degree=" + degree
            + " --set 'Estimation/Estimators=spr, residual, averaging, equilibrated, local degree "
              "extrapolation'";
        for (const bool bearing : {true, false})
          {
            const Table table
              = run_scene(bearing ? "pin" : "moment", lug(bearing ? pin : slab), options);
            // (0, 0, 3) x F + M
            if (bearing)
              check_load("  pin, degree " + degree, "pin", "l", {1., 1., 0.}, 4);
            else
              check_load("  force and moment, degree " + degree,
                         "moment",
                         "l",
                         {1., -2., .5, 6.5, 5., -1.},
                         4);
            // Estimates of one error; the bound is above that of the flux projection, and the
            // constants of the residual are made for P1 and P2.
            const double spr = table.last("estimate_spr");
            within("bound", table.last("estimate_equilibrated") / spr, 1., 1.6);
            within("residual", table.last("estimate_residual") / spr, 0.6, 1.6);
            within("averaging", table.last("estimate_averaging") / spr, 0.5, 1.5);
          }
      }
  }

  /** The pressure of the pin, written with the normal: k cos, with int k cos^2 = sqrt(2) over the
   * quarter. Its force is that up to the chords of the mesh. */
  void
  with_normal()
  {
    const std::string options = "--set Adaptivity/Strategy=uniform --set 'Adaptivity/Maximum "
                                "cycles=3' --set 'Adaptivity/Maximum tetrahedra=100000' --set "
                                "'Estimation/Estimators=spr, residual, averaging, equilibrated'";
    const Table       pin     = run_scene("pin",
                                lug("set Type = total force\nset Groups = inner\nset Value = 1; 1; "
                                              "0\nset Distribution = bearing"),
                                options);
    const Table       same    = run_scene(
      "same",
      lug("set Type = pressure\nset Groups = inner\nset Value = max(0, -(nx+ny))/(pi/4 + 0.5)"),
      options);
    for (const std::string column : {"strain_energy",
                                     "estimate_spr",
                                     "estimate_residual",
                                     "estimate_averaging",
                                     "estimate_equilibrated"})
      {
        const double ratio = pin.last(column) / same.last(column);
        check("  " + column + " as with a pressure", std::abs(ratio - 1.) < 0.02);
      }
  }

  /** A bar 2 x 1 x 1 of density 2. */
  std::string
  bar(const std::string &load, const std::string &support = "set Groups = x-min")
  {
    return block("Mesh", "set Type = bricks\nset Upper corner = 2, 1, 1\nset Cells = 4x2x2")
           + block("Materials",
                   block("m", "set Young modulus = 1000\nset Poisson ratio = 0.3\nset Density = 2"))
           + block("Supports", block("foot", support)) + block("Loads", block("l", load))
           + block("Solver", "set Tolerance = 1e-12") + output;
  }

  const std::vector<std::string> all_ways{
    "--set Degree=1 --set 'Estimation/Estimators=spr, residual, averaging, degree extrapolation, "
    "local degree extrapolation, equilibrated'",
    "--set Degree=2 --set 'Estimation/Estimators=spr, residual, averaging, equilibrated'",
    "--set Degree=2 --set Reference/Type=hexahedra --set 'Reference/Maximum unknowns=30000' --set "
    "Estimation/Estimators=energy",
    "--set Degree=2 --set Formulation=mixed --set Estimation/Estimators=spr"};

  /** Loads that can also be said otherwise. */
  void
  equal()
  {
    const struct
    {
      std::string what, load, same;
    } pairs[] = {
      // On a square of side 1 with centroid c: F + 12 M_y (z - c_z) and so on.
      {"force and moment",
       "set Type = total force\nset Groups = x-max\nset Value = 1; 2; 3\nset Moment = 0.6; 0.2; "
       "0.1",
       "set Type = traction\nset Groups = x-max\nset Value = 1 + 12*0.2*(z-0.5) - "
       "12*0.1*(y-0.5); 2 - 6*0.6*(z-0.5); 3 + 6*0.6*(y-0.5)"},
      {"force beside the centroid",
       "set Type = total force\nset Groups = x-max\nset Value = 4; 0; 0\nset About = 2, 0.5, 0.75",
       "set Type = traction\nset Groups = x-max\nset Value = 4 + 12*(z-0.5); 0; 0"},
      {"force on a wedge",
       "set Type = total force\nset Groups = x-max, z-max\nset Value = 0; 0; -4\nset Distribution "
       "= "
       "bearing",
       "set Type = pressure\nset Groups = x-max, z-max\nset Value = 2*nz"},
      {"rotation",
       "set Type = rotation\nset Axis point = 0.5, 0.5, 7\nset Axis = 0, 0, -3\nset Angular "
       "velocity = 3",
       "set Type = body force\nset Value = 18*(x-0.5); 18*(y-0.5); 0"}};
    for (const auto &pair : pairs)
      for (const std::string &options : all_ways)
        {
          const Table one = run_scene("one", bar(pair.load), options);
          const Table two = run_scene("two", bar(pair.same), options);
          check("  " + pair.what, one.distance(two) < 1e-7);
          if (!(one.distance(two) < 1e-7))
            std::cout << "  " << one.distance(two) << std::endl;
        }
  }

  void
  rotating()
  {
    const std::string scene_file = scene("verification/rotating_block_p2.prm");
    const fs::path    folder     = fresh("rotating");
    const auto        result
      = run("--quiet --set Solver/Tolerance=1e-12 --output-directory rotating " + scene_file);
    std::cout << "rotating block: exit code " << result.code << '\n'
              << (result.code == 0 ? "" : result.err);
    const Table table(folder);
    check("  error falls in every cycle", table.falls("relative_energy_error"));
    check("  small error", table.last("relative_energy_error") < 4e-3);
    check("  effectivity of spr", std::abs(table.last("effectivity_spr") - 1.) < 0.1);
    check("  a bound, and near",
          table.last("effectivity_equilibrated") > 1.
            && table.last("effectivity_equilibrated") < 1.1);
    // rho w^2 A L^2 / 2 = 8 * 1 * 4 / 2 and 8 * 2 * 1 / 2.
    check_load("  reaction along the arm", folder, "axis x", {-16., 0., 0.}, 3, "support");
    check_load("  reaction across it", folder, "axis y", {0., -8., 0.}, 3, "support");
  }

  void
  refused(const std::string &what, const std::string &load)
  {
    fresh("out");
    write("s.prm", bar(load));
    const auto result = run("--quiet --output-directory out s.prm");
    std::cout << what << ": exit code " << result.code << '\n'
              << portable(result.err) << std::flush;
  }

  void
  refusals()
  {
    const std::string on = "set Groups = x-max\nset Type = ";
    refused("expressions", on + "total force\nset Value = x; 1; nx\nset Moment = 0; y; 0");
    refused("one number", on + "total force\nset Value = 3");
    refused("moment of a pressure", on + "pressure\nset Value = 1\nset Moment = 0; 0; 1");
    refused("all of it in a traction",
            on
              + "traction\nset Value = 1; 0; 0\nset About = 0, 0, 1\nset Distribution = "
                "bearing\nset Axis = 0, 0, 1\nset Axis point = 1, 0, 0\nset Angular velocity = 2");
    refused("bearing with a moment",
            on
              + "total force\nset Value = -1; 0; 0\nset Distribution = bearing\nset Moment = 1; "
                "0; 0\nset About = 0, 0, 0");
    refused("bearing without a force", on + "total force\nset Distribution = bearing");
    refused("bearing that is pulled",
            on + "total force\nset Value = 1; 0; 0\nset Distribution = bearing");
    refused("total force with a feature",
            on + "total force\nset Value = 1; 0; 0\nset Smallest feature = 0.1");
    refused("nothing at all", on + "total force\nset Value = 0; 0; 0");
    refused("rotation without an axis", "set Type = rotation\nset Angular velocity = 1");
    refused("rotation about no direction",
            "set Type = rotation\nset Axis = 0, 0, 0\nset Angular velocity = 1\nset Value = 1; 0; "
            "0");
    refused("rotation on faces", on + "rotation\nset Axis = 0, 0, 1\nset Angular velocity = 1");
    refused("rotation that stands", "set Type = rotation\nset Axis = 0, 0, 1");
    write("s.prm", bar("set Type = rotation\nset Axis = 0, 0, 1\nset Angular velocity = 1"));
    const auto result = run("--quiet --set Materials/m/Density=0 s.prm");
    std::cout << "rotation without a density: exit code " << result.code << '\n' << result.err;
    fresh("out");
    write("s.prm",
          bar("set Type = total force\nset Groups = x-max, z-max\nset Value = -1; 0; "
              "-0.5\nset Distribution = bearing"));
    const auto told = run("--quiet --output-directory out s.prm");
    std::cout << "unsymmetric bearing: exit code " << told.code << '\n' << told.err;
  }
} // namespace

int
main()
{
  projected();
  with_normal();
  equal();
  rotating();
  refusals();
}
