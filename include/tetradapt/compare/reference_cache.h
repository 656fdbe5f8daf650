// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_compare_reference_cache_h
#define tetradapt_compare_reference_cache_h

#include "tetradapt/mesh/hexahedral_field.h"
#include "tetradapt/mesh/nodal_field.h"

#include <mpi.h>

#include <memory>
#include <string>

namespace tetradapt::compare
{
  /** A reference as it is kept on disk. */
  struct CachedReference
  {
    mesh::TetMesh                     mesh; ///< empty for a reference on hexahedra
    unsigned int                      degree = 1;
    std::vector<dealii::Tensor<1, 3>> values;    ///< one a node of a field of this degree
    std::vector<double>               pressures; ///< of a solution in mixed form, else empty
    /** Of a mesh::HexahedralField: planes and cells. */
    std::array<std::vector<double>, 3>       planes;
    std::vector<mesh::HexahedralField::Cell> hexahedra;
    double                                   energy = 0., estimated_error = 0.;
    double                                   known_energy = 0.; ///< 0: none
    double                                   seconds      = 0.; ///< what it took to compute
    std::string                              description;       ///< of mesh and size, for the log
  };

  /** Gives it from the first rank to all, but for the places that its mesh keeps. Collective. */
  void
  broadcast(CachedReference &reference, MPI_Comm communicator);

  /** What read_reference_cache() found. */
  struct CacheResult
  {
    /** Null if there is no file or if it cannot be used. */
    std::unique_ptr<CachedReference> reference;
    /** Why an existing file cannot be used, for a warning; else empty. */
    std::string problem;
  };

  /**
   * Writes a reference to @p file: a header with format, byte order, key, length
   * and checksum of the rest (see Fingerprint), then the bare arrays. The file
   * appears whole under its name, so that processes that read or write it at
   * the same time do not disturb each other; the last writer wins, and all of
   * them have computed the same.
   *
   * @param key the hash of what determines the reference (reference_key()).
   * @throws as core::AtomicFile does.
   */
  void
  write_reference_cache(const std::string     &file,
                        const std::string     &key,
                        const CachedReference &reference);

  /** Reads what write_reference_cache() has written for @p key. Never throws for
   * what is in the file: one that is damaged, truncated, of another format or
   * for another key is a problem that the result names. */
  CacheResult
  read_reference_cache(const std::string &file, const std::string &key);
} // namespace tetradapt::compare

#endif
