// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/kept_reference.h"

#include "tetradapt/compare/reference_cache.h"
#include "tetradapt/compare/reference_key.h"
#include "tetradapt/core/exceptions.h"
#include "tetradapt/core/on_first_rank.h"
#include "tetradapt/mesh/mesh_broadcast.h"

#include <filesystem>
#include <sstream>

namespace tetradapt::compare
{
  namespace
  {
    std::string
    cache_directory(const scene::ReferenceParameters &parameters)
    {
      const std::filesystem::path path = parameters.cache_directory.empty()
                                           ? std::filesystem::path("output") / "cache"
                                           : std::filesystem::path(parameters.cache_directory);
      return std::filesystem::absolute(path).lexically_normal().string();
    }

    /** A field on hexahedra that the first rank has. Collective. */
    std::shared_ptr<const mesh::HexahedralField>
    share_hexahedra(CachedReference cached, MPI_Comm communicator)
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
  } // namespace

  std::shared_ptr<const mesh::NodalField>
  share_field(mesh::TetMesh                     mesh,
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

  KeptReference::KeptReference(const scene::Scene  &scene,
                               const mesh::TetMesh &initial_mesh,
                               MPI_Comm             communicator,
                               const core::Log     &log)
    : communicator(communicator), log(log)
  {
    core::on_first_rank(communicator, [&] {
      key  = reference_key(scene, initial_mesh);
      file = cache_directory(scene.reference) + "/reference_" + key + ".bin";
    });
  }

  std::optional<Reference>
  KeptReference::load() const
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
      return std::nullopt;
    Reference    reference;
    const double seconds      = cached.seconds;
    reference.description     = cached.description;
    reference.energy          = numbers[1];
    reference.estimated_error = numbers[2];
    reference.from_cache      = true;
    if (numbers[3] != 0.)
      reference.known_energy = numbers[3];
    if (numbers[4] != 0.)
      reference.displacement.hexahedra = share_hexahedra(std::move(cached), communicator);
    else
      reference.displacement.tetrahedra = share_field(std::move(cached.mesh),
                                                      cached.degree,
                                                      std::move(cached.values),
                                                      std::move(cached.pressures),
                                                      communicator);
    std::ostringstream text;
    text.precision(3);
    text << "Reference: reused from " << file << " (" << seconds << " s saved)";
    log.detail(text.str());
    return reference;
  }

  void
  KeptReference::store(const Reference &reference) const
  {
    core::on_first_rank(communicator, [&] {
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
    });
  }
} // namespace tetradapt::compare
