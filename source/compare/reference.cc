// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/reference.h"

#include "tetradapt/compare/reference_cache.h"
#include "tetradapt/compare/reference_key.h"
#include "tetradapt/compare/reference_mesh.h"
#include "tetradapt/compare/root_of_squares.h"
#include "tetradapt/core/exceptions.h"
#include "tetradapt/core/on_first_rank.h"
#include "tetradapt/io/vtu_reader.h"
#include "tetradapt/mesh/mesh_broadcast.h"
#include "tetradapt/solve/energies.h"
#include "tetradapt/solve/hexahedral_solution.h"
#include "tetradapt/solve/static_solution.h"

#include <chrono>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace tetradapt::compare
{
  namespace
  {
    using Route = scene::ReferenceParameters::MeshRoute;
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

    /** Without what is left out. */
    double
    own_error(const CellErrors             &cell_errors,
              const mesh::NodalField       &displacement,
              const mechanics::MaterialMap &materials,
              MPI_Comm                      communicator,
              const scene::Scene           *scene,
              const ExcludedRegion         &excluded)
    {
      auto errors = cell_errors(displacement, materials, communicator, scene);
      if (!excluded.empty())
        excluded.clear(displacement.mesh(), errors);
      return root_of_squares(errors);
    }

    Reference
    solve_reference(const scene::Scene           &scene,
                    const mechanics::MaterialMap &materials,
                    const mesh::TetMesh          &initial_mesh,
                    MPI_Comm                      communicator,
                    const core::Log              &log,
                    const CellErrors             &cell_errors,
                    const ExcludedRegion         &excluded)
    {
      const auto mesh = mesh::make_on_first_rank(communicator, [&] {
        return reference_mesh(scene, initial_mesh, log);
      });
      const auto solution
        = solve::solve_static(scene, materials, mesh, scene.reference.degree, communicator, log);
      Reference reference;
      reference.displacement.tetrahedra = solution.displacement;
      reference.energy                  = solution.energy;
      log.progress("reference: estimating its error");
      reference.estimated_error
        = own_error(cell_errors, *solution.displacement, materials, communicator, &scene, excluded);
      const Route route = scene.reference.route;
      reference.description
        = describe(*solution.displacement,
                   route == Route::refine   ? "refined from the initial mesh"
                   : route == Route::bricks ? "bricks"
                                            : "mesh of " + scene.reference.file);
      return reference;
    }

    Reference
    solve_hexahedra(const scene::Scene           &scene,
                    const mechanics::MaterialMap &materials,
                    const mesh::TetMesh          &initial_mesh,
                    MPI_Comm                      communicator,
                    const core::Log              &log)
    {
      const double tolerance = hexahedral_tolerance(scene);
      const auto   solution
        = solve::solve_on_hexahedra(scene, materials, initial_mesh, tolerance, communicator, log);
      Reference reference;
      reference.displacement.hexahedra = solution.displacement;
      reference.energy                 = solution.energy;
      reference.estimated_error        = solution.estimated_error;
      reference.known_energy           = solution.extrapolated_energy;
      std::ostringstream text;
      text << 'Q' << solution.displacement->degree() << ", " << solution.displacement->n_cells()
           << " hexahedra, " << solution.n_dofs << " unknowns, refined where its error is";
      reference.description = text.str();
      if (!solution.reached)
        log.warning("Reference/Maximum unknowns stopped the refinement of the reference before its "
                    "tolerance: the estimate of its relative energy error is "
                    + number(solution.estimated_error / solution.norm) + " instead of "
                    + number(tolerance) + ".");
      return reference;
    }

    std::string
    cache_directory(const scene::ReferenceParameters &parameters)
    {
      const std::filesystem::path path = parameters.cache_directory.empty()
                                           ? std::filesystem::path("output") / "cache"
                                           : std::filesystem::path(parameters.cache_directory);
      return std::filesystem::absolute(path).lexically_normal().string();
    }

    /** Writing is a convenience: when it fails, the run goes on. */
    void
    store(const std::string &file,
          const std::string &key,
          const Reference   &reference,
          const core::Log   &log)
    {
      try
        {
          std::filesystem::create_directories(std::filesystem::path(file).parent_path());
          CachedReference cached;
          cached.degree = reference.displacement.degree();
          if (const auto &hexahedra = reference.displacement.hexahedra)
            {
              cached.planes    = hexahedra->planes();
              cached.hexahedra = hexahedra->cells();
              cached.values    = hexahedra->values();
            }
          else
            {
              cached.mesh   = reference.displacement.tetrahedra->mesh();
              cached.values = reference.displacement.tetrahedra->values;
              if (const auto &pressure = reference.displacement.tetrahedra->pressure)
                cached.pressures = pressure->values;
            }
          cached.known_energy    = reference.known_energy.value_or(0.);
          cached.energy          = reference.energy;
          cached.estimated_error = reference.estimated_error;
          cached.seconds         = reference.seconds;
          cached.description     = reference.description;
          write_reference_cache(file, key, cached);
          log.detail("Reference: kept for later runs in " + file);
        }
      catch (const std::exception &error)
        {
          log.warning(std::string("The reference could not be kept for later runs: ")
                      + error.what());
        }
    }

    /** Makes a field of a mesh and of values that rank 0 has. Collective. */
    std::shared_ptr<mesh::NodalField>
    share(mesh::TetMesh                     mesh,
          unsigned int                      degree,
          std::vector<dealii::Tensor<1, 3>> values,
          std::vector<double>               pressures,
          MPI_Comm                          communicator)
    {
      mesh::broadcast(mesh, communicator);
      core::broadcast_bytes(&degree, sizeof(degree), communicator);
      core::broadcast(values, communicator);
      core::broadcast(pressures, communicator);
      auto field
        = std::make_shared<mesh::NodalField>(std::make_shared<const mesh::TetMesh>(std::move(mesh)),
                                             degree);
      std::shared_ptr<mesh::PressureField> pressure;
      if (!pressures.empty())
        pressure = std::make_shared<mesh::PressureField>(field->mesh());
      if (values.size() != field->values.size()
          || (pressure && pressures.size() != pressure->values.size()))
        throw core::NumericalError("A reference was read whose displacement does not fit its mesh. "
                                   "Remove the cache directory and run again.");
      field->values = std::move(values);
      if (pressure)
        pressure->values = std::move(pressures);
      field->pressure = pressure;
      return field;
    }

    /** The same on hexahedra. Collective. */
    std::shared_ptr<const mesh::HexahedralField>
    share(CachedReference cached, MPI_Comm communicator)
    {
      core::broadcast_bytes(&cached.degree, sizeof(cached.degree), communicator);
      for (auto &planes : cached.planes)
        core::broadcast(planes, communicator);
      core::broadcast(cached.hexahedra, communicator);
      core::broadcast(cached.values, communicator);
      return std::make_shared<mesh::HexahedralField>(cached.degree,
                                                     std::move(cached.planes),
                                                     std::move(cached.hexahedra),
                                                     std::move(cached.values));
    }

    /** Takes the reference from the cache; false if it is not there. Collective. */
    bool
    load(const std::string &file,
         const std::string &key,
         MPI_Comm           communicator,
         const core::Log   &log,
         Reference         &reference)
    {
      CachedReference cached;
      double          numbers[5] = {0., 0., 0., 0., 0.}; // whether it was found, then its figures
      core::on_first_rank(communicator, [&] {
        CacheResult result = read_reference_cache(file, key);
        if (!result.problem.empty())
          log.warning("The kept reference " + file + " cannot be used: " + result.problem
                      + ". It is computed again.");
        if (!result.reference)
          return;
        cached     = std::move(*result.reference);
        numbers[0] = 1.;
        numbers[1] = cached.energy;
        numbers[2] = cached.estimated_error;
        numbers[3] = cached.known_energy;
        numbers[4] = cached.hexahedra.empty() ? 0. : 1.;
      });
      core::broadcast_bytes(numbers, sizeof(numbers), communicator);
      if (numbers[0] == 0.)
        return false;
      const double seconds      = cached.seconds;
      reference.description     = cached.description;
      reference.energy          = numbers[1];
      reference.estimated_error = numbers[2];
      reference.from_cache      = true;
      if (numbers[3] != 0.)
        reference.known_energy = numbers[3];
      if (numbers[4] != 0.)
        reference.displacement.hexahedra = share(std::move(cached), communicator);
      else
        reference.displacement.tetrahedra = share(std::move(cached.mesh),
                                                  cached.degree,
                                                  std::move(cached.values),
                                                  std::move(cached.pressures),
                                                  communicator);
      log.detail("Reference: reused from " + file + " (" + number(seconds) + " s saved)");
      return true;
    }

    Reference
    fine_reference(const scene::Scene           &scene,
                   const mechanics::MaterialMap &materials,
                   const mesh::TetMesh          &initial_mesh,
                   MPI_Comm                      communicator,
                   const core::Log              &log,
                   const CellErrors             &cell_errors,
                   const ExcludedRegion         &excluded)
    {
      const auto  start = Clock::now();
      std::string file, key;
      Reference   reference;
      if (scene.reference.cache)
        {
          core::on_first_rank(communicator, [&] {
            key  = reference_key(scene, initial_mesh);
            file = cache_directory(scene.reference) + "/reference_" + key + ".bin";
          });
          if (load(file, key, communicator, log, reference))
            return reference;
        }
      reference         = scene.reference.type == scene::ReferenceParameters::Type::hexahedra
                            ? solve_hexahedra(scene, materials, initial_mesh, communicator, log)
                            : solve_reference(
                      scene, materials, initial_mesh, communicator, log, cell_errors, excluded);
      reference.seconds = seconds_since(start);
      if (scene.reference.cache)
        core::on_first_rank(communicator, [&] { store(file, key, reference, log); });
      return reference;
    }

    Reference
    reference_of_run(const scene::Scene           &scene,
                     const mechanics::MaterialMap &materials,
                     MPI_Comm                      communicator,
                     const core::Log              &log,
                     const CellErrors             &cell_errors,
                     const ExcludedRegion         &excluded)
    {
      const std::string                &file = scene.reference.file;
      mesh::TetMesh                     mesh;
      unsigned int                      degree = 1;
      std::vector<dealii::Tensor<1, 3>> values;
      core::on_first_rank(communicator, [&] {
        log.progress("reference: reading " + file);
        const auto run = io::read_displacement_vtu(file);
        mesh           = run.displacement->mesh();
        degree         = run.displacement->degree();
        values         = run.displacement->values;
        for (const int region : mesh.regions)
          materials.linear_law(region); // throws for one without material
      });
      const auto field = share(std::move(mesh), degree, std::move(values), {}, communicator);
      Reference  reference;
      reference.displacement.tetrahedra = field;
      reference.energy = solve::compute_energies(*field, materials, communicator).energy;
      reference.estimated_error
        = own_error(cell_errors, *field, materials, communicator, nullptr, excluded);
      reference.description = describe(*field, "read from " + file);
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

  Reference
  make_reference(const scene::Scene                  &scene,
                 const mechanics::MaterialMap        &materials,
                 std::shared_ptr<const mesh::TetMesh> initial_mesh,
                 MPI_Comm                             communicator,
                 const core::Log                     &log,
                 const CellErrors                    &cell_errors,
                 const ExcludedRegion                &excluded)
  {
    const auto start = Clock::now();
    if (scene.reference.type == scene::ReferenceParameters::Type::none)
      throw core::InputError("A reference is needed, but Reference/Type is none.");
    Reference reference
      = scene.reference.type == scene::ReferenceParameters::Type::run
          ? reference_of_run(scene, materials, communicator, log, cell_errors, excluded)
          : fine_reference(
            scene, materials, *initial_mesh, communicator, log, cell_errors, excluded);
    reference.seconds = seconds_since(start);
    if (reference.displacement.tetrahedra != nullptr)
      compare_bodies(reference.displacement.tetrahedra->mesh(), *initial_mesh, log);
    return reference;
  }
} // namespace tetradapt::compare
