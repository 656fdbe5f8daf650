// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_compare_kept_reference_h
#define tetradapt_compare_kept_reference_h

#include "tetradapt/compare/reference.h"
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

  /** A field of a mesh and of values at its nodes that the first rank has, on every rank.
   * @param pressures of the mixed form, else empty. Collective.
   * @throws core::NumericalError if there are more or fewer values than nodes. */
  std::shared_ptr<const mesh::NodalField>
  share_field(mesh::TetMesh                     mesh,
              unsigned int                      degree,
              std::vector<dealii::Tensor<1, 3>> values,
              std::vector<double>               pressures,
              MPI_Comm                          communicator);
} // namespace tetradapt::compare

#endif
