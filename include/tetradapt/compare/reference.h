// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_compare_reference_h
#define tetradapt_compare_reference_h

#include "tetradapt/compare/reference_sampling.h"

#include <optional>
#include <string>

namespace tetradapt::compare
{
  /** A fine solution, and how wrong it is itself. Every rank holds all of it. */
  struct Reference
  {
    ReferenceField displacement;
    double         energy = 0.; ///< a(u_ref,u_ref)
    /** Of the reference itself, energy norm, absolute: by recovery on tetrahedra, by what
     * refinement gained on hexahedra. */
    double estimated_error = 0.;
    /** a(u,u) of the solution itself, extrapolated over the meshes of hexahedra: a known
     * energy, whose error is a part of the square of estimated_error. */
    std::optional<double> known_energy;
    bool                  from_cache = false;
    std::string           description;  ///< for the log: where it came from, its size
    double                seconds = 0.; ///< what it took to obtain
  };
} // namespace tetradapt::compare

#endif
