// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/kept_reference.h"

#include "tetradapt/compare/reference_key.h"
#include "tetradapt/core/on_first_rank.h"

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
  } // namespace

  ReferenceField
  displacement_of(CachedReference cached)
  {
    ReferenceField displacement;
    if (!cached.hexahedra.empty())
      {
        displacement.hexahedra
          = std::make_shared<mesh::HexahedralField>(cached.degree,
                                                    std::move(cached.planes),
                                                    std::move(cached.hexahedra),
                                                    std::move(cached.values));
        return displacement;
      }
    const auto field = std::make_shared<mesh::NodalField>(
      std::make_shared<const mesh::TetMesh>(std::move(cached.mesh)), cached.degree);
    field->values = std::move(cached.values);
    if (!cached.pressures.empty())
      {
        const auto pressure = std::make_shared<mesh::PressureField>(field->mesh());
        pressure->values    = std::move(cached.pressures);
        field->pressure     = pressure;
      }
    displacement.tetrahedra = field;
    return displacement;
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
    bool            found = false;
    core::on_first_rank(communicator, [&] {
      CacheResult result = read_reference_cache(file, key);
      if (!result.problem.empty())
        log.warning("The kept reference " + file + " cannot be used: " + result.problem
                    + ". It is computed again.");
      found = result.reference != nullptr;
      if (found)
        cached = std::move(*result.reference);
    });
    core::broadcast_bytes(&found, sizeof(found), communicator);
    if (!found)
      return std::nullopt;
    broadcast(cached, communicator);
    std::ostringstream text;
    text.precision(3);
    text << "Reference: reused from " << file << " (" << cached.seconds << " s saved)";
    log.detail(text.str());
    Reference reference;
    reference.energy          = cached.energy;
    reference.estimated_error = cached.estimated_error;
    if (cached.known_energy != 0.)
      reference.known_energy = cached.known_energy;
    reference.from_cache   = true;
    reference.description  = cached.description;
    reference.displacement = displacement_of(std::move(cached));
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
