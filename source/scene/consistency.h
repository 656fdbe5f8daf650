// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_scene_consistency_h
#define tetradapt_scene_consistency_h

#include "tetradapt/laws/law_catalogue.h"
#include "tetradapt/scene/mistakes.h"
#include "tetradapt/scene/scene.h"

#include <functional>

namespace tetradapt::scene
{
  /** Checks each part of @p scene that could be read, and how those that are sound fit together;
   * adds "<full name>: <what is wrong and what to change>" to @p mistakes. */
  void
  check_scene(const Scene &scene, Mistakes &mistakes);

  /** What the formulation asks of degree, materials, reference, goals and estimators.
   * @throws core::InputError */
  void
  check_formulation(const Scene &scene);

  /** What large deformation asks of loads, reference, goals, estimators and adaptivity.
   * @throws core::InputError */
  void
  check_finite_strain(const Scene &scene);

  /** One message for each material for which the displacement form is poor; see
   * doc/mixed_form.md. */
  std::vector<std::string>
  locking_warnings(const Scene &scene);

  /** The name of the first estimator of the scene, the refinement indicator of an adaptive run
   * first, that tells an energy norm without reference or exact solution; empty: none. */
  std::string
  energy_estimator(const Scene &scene);

  /** Whether the three expressions are constants of value zero. */
  bool
  all_zero(const std::array<std::string, 3> &expressions);

  /** Whether a material on which the volume load @p load can act has @p property.
   * A material that fills "all other" regions counts as one it can act on. */
  bool
  any_material(const Scene                                           &scene,
               const LoadParameters                                  &load,
               const std::function<bool(const MaterialParameters &)> &property);

  /** Whether the temperature @p load acts on a material with thermal expansion. */
  bool
  expands(const Scene &scene, const LoadParameters &load);

  /** @throws InputError if two supports on the same selection prescribe different
   * displacements of one component. */
  void
  check_compatible(const SupportParameters &first, const SupportParameters &second);

  /** What sliding and rigid supports ask of formulation, reference, solver and estimators.
   * @throws core::InputError */
  void
  check_support_types(const Scene &scene);

  /** The parameter of a material's law that is, say, &laws::LawEntry::stiffness. */
  std::string
  constant_path(const MaterialParameters &material, std::string laws::LawEntry::*constant);

  /** @throws InputError if a Young modulus leaves the range in which energies can be
   * computed, or if one is more than 1e12 times another. */
  void
  check_stiffness(const Scene &scene);

  /** What to tell about a contrast of Young moduli that costs digits; empty: nothing. */
  std::string
  stiffness_warning(const Scene &scene);

  /**
   * Compares the exact gradient with differences of its displacement at
   * some points of a box; nothing is done for other meshes, whose inside is not
   * known yet.
   * @throws InputError naming the entry that differs.
   */
  void
  check_exact_gradient(const Scene &scene);
} // namespace tetradapt::scene

#endif
