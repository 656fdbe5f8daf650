// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_laws_law_catalogue_h
#define tetradapt_laws_law_catalogue_h

#include "tetradapt/laws/constitutive_law.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tetradapt::laws
{
  /** A constant that a law needs. */
  struct Constant
  {
    std::string name; ///< as users write it: "Young modulus"
    double      standard;
    std::string documentation;
    /** Empty, or what is wrong with a value: "must be positive". */
    std::function<std::string(double)> mistake;
  };

  /** A law that users can name. */
  struct LawEntry
  {
    std::string           name; ///< as users write it
    std::string           documentation;
    std::vector<Constant> constants;
    /** Names of the constants to change for another stiffness and for another Poisson ratio. */
    std::string stiffness, compressibility;
    /** Makes the law from values for all its constants. */
    std::function<std::unique_ptr<ConstitutiveLaw>(const Constants &)> make;
  };

  /**
   * All laws. To add one: write its class, add an entry where this is defined, and a test that
   * compares energy, stress and tangent with differences. A constant that several laws have is
   * the same object for all.
   */
  const std::vector<LawEntry> &
  law_catalogue();

  /** The entry of the law @p name.
   * @throws core::InputError listing the valid names for an unknown one. */
  const LawEntry &
  find_law(const std::string &name);

  /** The constants of all laws, each once, in the order in which laws name them. */
  std::vector<Constant>
  all_constants();

  /** The values of all constants of the law @p name, and of no others.
   * @throws core::InputError for an unknown name. */
  Constants
  values_of(const std::string &name, const Constants &constants);

  /**
   * Makes the law @p name.
   * @throws core::InputError for an unknown name, or for constants that the law refuses.
   */
  std::unique_ptr<ConstitutiveLaw>
  make_law(const std::string &name, const Constants &constants);
} // namespace tetradapt::laws

#endif
