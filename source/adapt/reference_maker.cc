// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/adapt/reference_maker.h"

#include "tetradapt/adapt/hexahedral_reference.h"
#include "tetradapt/compare/kept_reference.h"
#include "tetradapt/compare/reference_mesh.h"
#include "tetradapt/compare/root_of_squares.h"
#include "tetradapt/core/exceptions.h"
#include "tetradapt/core/on_first_rank.h"
#include "tetradapt/estimate/recovery/recovery.h"
#include "tetradapt/fem/replication.h"
#include "tetradapt/io/vtu_reader.h"
#include "tetradapt/mesh/mesh_broadcast.h"
#include "tetradapt/solve/energies.h"
#include "tetradapt/solve/static_solution.h"

#include <chrono>
#include <cmath>
#include <sstream>

namespace tetradapt::adapt
{
  namespace
  {
    using compare::Reference;
    using Route = scene::ReferenceParameters::MeshRoute;
    using Type  = scene::ReferenceParameters::Type;
    using Clock = std::chrono::steady_clock;

    double
    seconds_since(const Clock::time_point start)
    {
      return std::chrono::duration<double>(Clock::now() - start).count();
    }

    std::string
    number(const double value)
    {
      std::ostringstream text;
      text.precision(3);
      text << value;
      return text.str();
    }

    std::string
    describe(const mesh::NodalField &field, const std::string &origin)
    {
      std::ostringstream text;
      text << 'P' << field.degree() << ", " << field.mesh().n_cells() << " tetrahedra, "
           << 3ul * field.n_nodes() << " unknowns, " << origin;
      return text.str();
    }

    /** Without what is left out. @param scene what was solved; null: unknown. */
    double
    own_error(const mesh::NodalField        &displacement,
              const mechanics::MaterialMap  &materials,
              MPI_Comm                       communicator,
              const scene::Scene            *scene,
              const compare::ExcludedRegion &excluded)
    {
      auto errors
        = estimate::recovery_estimate(displacement, materials, communicator, scene).cell_energy;
      if (!excluded.empty())
        excluded.clear(displacement.mesh(), errors);
      return compare::root_of_squares(errors);
    }

    Reference
    solve_reference(const scene::Scene            &scene,
                    const mechanics::MaterialMap  &materials,
                    const mesh::TetMesh           &initial_mesh,
                    MPI_Comm                       communicator,
                    const core::Log               &log,
                    const compare::ExcludedRegion &excluded)
    {
      const auto mesh = mesh::make_on_first_rank(communicator, [&] {
        return compare::reference_mesh(scene, initial_mesh, log);
      });
      const auto solution
        = solve::solve_static(scene, materials, mesh, scene.reference.degree, communicator, log);
      Reference  reference;
      const auto displacement           = fem::replicate(*solution.displacement);
      reference.displacement.tetrahedra = displacement;
      reference.energy                  = solution.energy;
      log.progress("reference: estimating its error");
      reference.estimated_error
        = own_error(*displacement, materials, communicator, &scene, excluded);
      const Route route = scene.reference.route;
      reference.description
        = describe(*displacement,
                   route == Route::refine   ? "refined from the initial mesh"
                   : route == Route::bricks ? "bricks"
                                            : "mesh of " + scene.reference.file);
      return reference;
    }

    Reference
    reference_of_run(const scene::Scene            &scene,
                     const mechanics::MaterialMap  &materials,
                     MPI_Comm                       communicator,
                     const core::Log               &log,
                     const compare::ExcludedRegion &excluded)
    {
      const std::string       &file = scene.reference.file;
      compare::CachedReference run;
      core::on_first_rank(communicator, [&] {
        log.progress("reference: reading " + file);
        const auto field = io::read_displacement_vtu(file).displacement;
        run.mesh         = field->mesh();
        run.degree       = field->degree();
        run.values       = field->values;
        for (const int region : run.mesh.regions)
          materials.linear_law(region); // throws for one without material
      });
      compare::broadcast(run, communicator);
      Reference reference;
      reference.displacement = compare::displacement_of(std::move(run));
      const auto &field      = *reference.displacement.tetrahedra;
      reference.energy
        = solve::compute_energies(*fem::distribute(field, communicator), materials).energy;
      reference.estimated_error = own_error(field, materials, communicator, nullptr, excluded);
      reference.description     = describe(field, "read from " + file);
      return reference;
    }

    /** Warns if the reference's mesh does not fill the same body. */
    void
    compare_bodies(const mesh::TetMesh &reference,
                   const mesh::TetMesh &initial_mesh,
                   const core::Log     &log)
    {
      const auto   ours = mesh::bounding_box(initial_mesh), theirs = mesh::bounding_box(reference);
      const double size = (ours.second - ours.first).norm();
      const double distance
        = std::max((ours.first - theirs.first).norm(), (ours.second - theirs.second).norm());
      const double volume = mesh::total_volume(initial_mesh);
      const double change = std::abs(mesh::total_volume(reference) - volume) / volume;
      if (distance > 1e-6 * size || change > 1e-6)
        log.warning("The reference's mesh does not fill the same body as the scene's: corners of "
                    "the bounding boxes are up to "
                    + number(distance) + " apart, the volumes differ by " + number(100. * change)
                    + " %. Points outside a mesh are compared with its nearest point, so the "
                      "error measured includes the difference of the bodies.");
    }
  } // namespace

  compare::Reference
  make_reference(const scene::Scene            &scene,
                 const mechanics::MaterialMap  &materials,
                 const mesh::TetMesh           &initial_mesh,
                 MPI_Comm                       communicator,
                 const core::Log               &log,
                 const compare::ExcludedRegion &excluded)
  {
    const auto                            start = Clock::now();
    std::optional<compare::KeptReference> kept;
    std::optional<Reference>              found;
    Reference                             reference;
    switch (scene.reference.type)
      {
      case Type::none:
        throw core::InputError("A reference is needed, but Reference/Type is none.");
      case Type::run:
        reference = reference_of_run(scene, materials, communicator, log, excluded);
        break;
      case Type::fine_mesh:
      case Type::hexahedra:
        if (scene.reference.cache)
          found = kept.emplace(scene, initial_mesh, communicator, log).load();
        if (found)
          reference = std::move(*found);
        else if (scene.reference.type == Type::hexahedra)
          reference = make_hexahedral_reference(scene, materials, initial_mesh, communicator, log);
        else
          reference = solve_reference(scene, materials, initial_mesh, communicator, log, excluded);
      }
    reference.seconds = seconds_since(start);
    if (kept && !found)
      kept->store(reference);
    if (reference.displacement.tetrahedra != nullptr)
      compare_bodies(reference.displacement.tetrahedra->mesh(), initial_mesh, log);
    return reference;
  }
} // namespace tetradapt::adapt
