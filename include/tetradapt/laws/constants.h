// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_laws_constants_h
#define tetradapt_laws_constants_h

#include <map>
#include <string>

namespace tetradapt::laws
{
  /** Constants of a law by the names that users write; the law's standard value counts for one
   * that is not there. */
  using Constants = std::map<std::string, double>;

  /** Of the small strains around the state of rest. */
  struct ModuliAtRest
  {
    double young_modulus, poisson_ratio;
  };
} // namespace tetradapt::laws

#endif
