// SPDX-License-Identifier: AGPL-3.0-or-later
//
// References on hexahedra: within their own estimate of a known energy, the same as solutions on
// tetrahedra for all kinds of supports and loads, as large as they may be, and in the cache what
// was put there; on one, two and three ranks.

#include "tetradapt/adapt/hexahedral_reference.h"
#include "tetradapt/adapt/reference_maker.h"
#include "tetradapt/compare/reference_key.h"
#include "tetradapt/io/mesh_source.h"

#include "../solve/solving.h"

#include <deal.II/base/mpi.h>

#include <cstring>
#include <filesystem>

using namespace bodies;
using scene::LoadType;

namespace
{
  bool         first_rank = true;
  unsigned int n_warnings = 0; ///< of the last reference, on the first rank
  std::string  last_warning;

  void
  say(const std::string &what, const bool holds)
  {
    if (first_rank)
      check(what, holds);
  }

  /** The scene's first mesh with its selections. */
  std::shared_ptr<mesh::TetMesh>
  mesh_of(const scene::Scene &scene)
  {
    return std::make_shared<mesh::TetMesh>(io::make_mesh(scene, 0, core::Log()));
  }

  compare::Reference
  hexahedral_reference(const scene::Scene &scene, const mesh::TetMesh &mesh)
  {
    n_warnings = 0;
    core::Log log;
    log.add_sink([&](const core::LogLevel level, const std::string &text) {
      if (level != core::LogLevel::warning)
        return;
      ++n_warnings;
      last_warning = text;
    });
    const mechanics::MaterialMap materials(scene, mesh);
    return adapt::make_hexahedral_reference(scene, materials, mesh, MPI_COMM_WORLD, log);
  }

  scene::Scene
  cantilever()
  {
    scene::Scene scene;
    scene.mesh.source       = scene::MeshSource::bricks;
    scene.mesh.upper_corner = Point<3>(10, 1, 1);
    scene.mesh.cells        = {{{10, 1, 1}}};
    scene.materials         = {material("beam", 1000., 0.3)};
    scene.supports          = {support("clamp", "x < 1e-9")};
    scene.loads             = {load("tip", LoadType::traction, "x > 9.9", {{"0", "0", "-1"}})};
    return scene;
  }

  void
  test_cantilever(const unsigned int degree, const double tolerance)
  {
    scene::Scene scene        = cantilever();
    scene.reference.degree    = degree;
    scene.reference.tolerance = tolerance;
    const auto        result  = hexahedral_reference(scene, *mesh_of(scene));
    const double      known   = 4.004143; // from 6 million unknowns, to 5e-7
    const double      error   = std::sqrt(known - result.energy);
    const std::string name    = "cantilever, degree " + std::to_string(degree) + ": ";
    say(name + "tolerance reached",
        n_warnings == 0 && result.estimated_error <= tolerance * std::sqrt(result.energy));
    say(name + "estimate not below the error", result.estimated_error >= error);
    say(name + "estimate not above twice the error", result.estimated_error <= 2. * error);
    say(name + "extrapolated energy within half of what is missing",
        std::abs(*result.known_energy - known) < .5 * (known - result.energy));
  }

  /** Where the system may not become large enough. */
  void
  test_limit()
  {
    scene::Scene scene        = cantilever();
    scene.reference.degree    = 2;
    scene.reference.tolerance = 1e-3;
    scene.reference.max_dofs  = 5000;
    const auto mesh           = mesh_of(scene);
    const auto result         = hexahedral_reference(scene, *mesh);
    say("limit: larger than that of the tolerance, but not without bound",
        result.estimated_error > 1e-3 * std::sqrt(result.energy)
          && result.estimated_error < std::sqrt(result.energy));
    say("limit: one warning that says so",
        n_warnings == 1
          && last_warning.find("Reference/Maximum unknowns stopped the refinement") == 0
          && last_warning.find(" instead of 0.001.") != std::string::npos);
    scene.reference.max_dofs = 100;
    try
      {
        hexahedral_reference(scene, *mesh);
        say("limit: too small for the first mesh", false);
      }
    catch (const core::InputError &error)
      {
        say("limit: too small for the first mesh",
            std::string(error.what()).find("Allow more, or use Type = fine mesh")
              != std::string::npos);
      }
  }

  /** All supports and loads at once, against quadratic tetrahedra. */
  void
  test_everything()
  {
    // A box, so that there are no strong singularities.
    scene::Scene scene;
    scene.mesh.source = scene::MeshSource::blocks;
    scene.mesh.blocks
      = {{Point<3>(0, 0, 0), Point<3>(1, 1, 1)}, {Point<3>(1, 0, 0), Point<3>(2, 1, 1)}};
    scene.mesh.block_regions             = {0, 1};
    scene.materials                      = {material("soft", 10., 0.3), material("hard", 20., 0.2)};
    scene.materials[1].regions           = {1};
    scene.materials[0].density           = 1.;
    scene.materials[1].density           = 2.;
    scene.materials[1].thermal_expansion = 0.02;
    scene.supports            = {support("wall", "x < 1e-9", "xyz", {{"0", "0.1*z", "0"}}),
                                 support("rail", "z < 1e-9 && x > 1 - 1e-9", "z")};
    scene.loads               = {load("weight", LoadType::gravity, "", {{"0", "0", "-0.3"}}),
                                 load("end", LoadType::traction, "x > 2 - 1e-9", {{"0.2", "0.3*z", "0.5"}}),
                                 load("lid", LoadType::pressure, "z > 1 - 1e-9", {{"x", "", ""}}),
                                 load("wind", LoadType::body_force, "", {{"0.1*z", "0.4*x", "0"}}),
                                 load("heat", LoadType::temperature, "", {{"2 + y", "", ""}})};
    scene.mesh.size           = "0.15";
    scene.reference.degree    = 2;
    scene.reference.max_dofs  = 40000;
    const auto mesh           = mesh_of(scene);
    scene.reference.tolerance = 0.02;
    const auto  hexahedra     = hexahedral_reference(scene, *mesh);
    const auto  tetrahedra    = solve_scene(scene, mesh, 2);
    const auto &field         = *hexahedra.displacement.hexahedra;
    double      largest = 0., difference = 0.;
    for (unsigned int n = 0; n < tetrahedra.whole->n_nodes(); ++n)
      {
        const auto &u  = tetrahedra.whole->values[n];
        const auto  at = field.locate(tetrahedra.whole->node_position(n));
        largest        = std::max(largest, u.norm());
        difference     = std::max(difference, (u - field.value(at.cell, at.unit)).norm());
      }
    say("everything: energies agree to 0.5 %",
        std::abs(hexahedra.energy / tetrahedra.energy - 1.) < 5e-3);
    say("everything: displacements agree to 1 %", difference < 1e-2 * largest);
    say("everything: no energy is known", !hexahedra.known_energy);
  }

  void
  test_cache()
  {
    const std::string directory = "hexahedra_test_cache";
    scene::Scene      scene;
    scene.mesh.source       = scene::MeshSource::bricks;
    scene.mesh.upper_corner = Point<3>(2, 1, 1);
    scene.mesh.cells        = {{{4, 2, 2}}};
    scene.materials         = {material("m", 10., 0.3)};
    scene.supports          = {support("wall", "x < 1e-9")};
    scene.loads             = {load("end", LoadType::traction, "x > 2 - 1e-9", {{"0", "0", "-1"}})};
    scene.reference.type    = scene::ReferenceParameters::Type::hexahedra;
    scene.reference.tolerance       = 0.05;
    scene.reference.degree          = 2;
    scene.reference.cache_directory = directory;
    if (first_rank)
      std::filesystem::remove_all(directory);
    MPI_Barrier(MPI_COMM_WORLD);
    const auto                   mesh = mesh_of(scene);
    const mechanics::MaterialMap materials(scene, *mesh);
    const auto                   make
      = [&] { return adapt::make_reference(scene, materials, *mesh, MPI_COMM_WORLD, {}); };
    const compare::Reference a = make(), b = make();
    const auto              &u = *a.displacement.hexahedra, &v = *b.displacement.hexahedra;
    say("solved, then reused", !a.from_cache && b.from_cache);
    say("with the same values",
        u.values().size() == v.values().size()
          && std::memcmp(u.values().data(),
                         v.values().data(),
                         u.values().size() * sizeof(Tensor<1, 3>))
               == 0
          && u.planes() == v.planes() && u.n_cells() == v.n_cells());
    say("and figures",
        a.energy == b.energy && a.estimated_error == b.estimated_error && a.known_energy
          && a.known_energy == b.known_energy && a.description == b.description);
    say("known energy above that of the reference", *a.known_energy > a.energy);
    const compare::ReferenceSampling sampling(b.displacement, materials, MPI_COMM_WORLD);
    say("energy by quadrature",
        std::abs(std::pow(sampling.energy_norm(), 2) / a.energy - 1.) < 1e-6);

    const std::string key   = compare::reference_key(scene, *mesh);
    auto              other = scene;
    other.mesh.cells        = {{{6, 3, 3}}};
    say("another mesh of tetrahedra, same key",
        key == compare::reference_key(other, io::make_mesh(other, 0, core::Log())));
    other                     = scene;
    other.reference.tolerance = 0.04;
    say("another tolerance, another key", key != compare::reference_key(other, *mesh));
    if (first_rank)
      std::filesystem::remove_all(directory);
  }
} // namespace

int
main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  first_rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  test_cantilever(2, 0.02);
  test_cantilever(3, 0.01);
  test_limit();
  test_everything();
  test_cache();
}
