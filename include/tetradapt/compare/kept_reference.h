// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_compare_kept_reference_h
#define tetradapt_compare_kept_reference_h

#include "tetradapt/compare/reference.h"
#include "tetradapt/compare/reference_cache.h"
#include "tetradapt/core/log.h"
#include "tetradapt/scene/scene.h"

namespace tetradapt::compare
{
  /** The scene's reference in the cache, where the first rank reads and writes it. */
  class KeptReference
  {
  public:
    /** Finds its place. Keeps a reference to @p log. Collective. @throws as reference_key(). */
    KeptReference(const scene::Scene  &scene,
                  const mesh::TetMesh &initial_mesh,
                  MPI_Comm             communicator,
                  const core::Log     &log);

    /** Empty if it is not there, or cannot be used, which is a warning. Collective. */
    std::optional<Reference>
    load() const;

    /** Keeps it for later runs. That this fails is a warning. Collective. */
    void
    store(const Reference &reference) const;

  private:
    MPI_Comm         communicator;
    const core::Log &log;
    std::string      file, key; ///< known to the first rank
  };

  /** The displacement of what was read. */
  ReferenceField
  displacement_of(CachedReference cached);
} // namespace tetradapt::compare

#endif
