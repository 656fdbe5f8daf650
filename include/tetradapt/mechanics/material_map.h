// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_material_map_h
#define tetradapt_mechanics_material_map_h

#include "tetradapt/core/expression.h"
#include "tetradapt/laws/constitutive_law.h"
#include "tetradapt/mesh/tet_mesh.h"
#include "tetradapt/scene/scene.h"

#include <map>
#include <memory>
#include <set>

namespace tetradapt::mechanics
{
  class VolumeDensity;

  using dealii::SymmetricTensor;
  using dealii::Tensor;
  using laws::ConstitutiveLaw;
  using laws::LinearLaw;
  using laws::PressureForm;

  /**
   * The region ids that a material or a load on the body names; all of them if
   * it names none.
   * @param what is the place in messages, such as "Loads/weight".
   * @throws core::InputError for a region or a group that @p mesh does not have.
   */
  std::set<int>
  resolve_regions(const std::vector<int>         &ids,
                  const std::vector<std::string> &groups,
                  const mesh::TetMesh            &mesh,
                  const std::string              &what);

  /**
   * The material of every region, the thermal strain that the scene's temperature
   * loads cause there, and its body forces. Made once a scene; region ids survive
   * remeshing, so it serves every mesh of the run and the reference alike.
   */
  class MaterialMap
  {
  public:
    /** @throws InputError if a region of @p mesh has no material, two claim it,
     *          or a material or temperature names a region that does not exist. */
    MaterialMap(const scene::Scene &scene, const mesh::TetMesh &mesh);

    /** Entries point into this object. */
    MaterialMap(const MaterialMap &) = delete;
    MaterialMap &
    operator=(const MaterialMap &)
      = delete;

    /** The law of region @p region. */
    const ConstitutiveLaw &
    law(int region) const;

    /** The same where only a law for small strains can be computed with.
     * @throws core::InputError naming the material for another law. */
    const LinearLaw &
    linear_law(int region) const;

    /** Whether all laws are linear, so that one linear solve suffices. */
    bool
    is_linear() const;

    const scene::MaterialParameters &
    parameters(int region) const;

    /** Whether the scene is solved in mixed form. */
    bool
    is_mixed() const
    {
      return mixed;
    }
    /** The law of region @p region in the mixed form.
     * @throws core::InputError if it has none. */
    PressureForm
    pressure_form(int region) const;

    bool
    has_thermal_strain() const;

    /** Thermal strain alpha T(x) I at @p point of @p region; zero without one. */
    SymmetricTensor<2, 3>
    thermal_strain(int region, const dealii::Point<3> &point) const;

    /** The linear thermal strain alpha T, in the first component, for integrals over cells. */
    const VolumeDensity &
    thermal_density() const
    {
      return *temperatures;
    }

    /** The body forces and weights, by their numbers among the scene's loads. */
    const std::map<unsigned int, std::shared_ptr<const VolumeDensity>> &
    body_forces() const
    {
      return forces;
    }

  private:
    struct Entry
    {
      const scene::MaterialParameters *parameters;
      std::shared_ptr<ConstitutiveLaw> law;
      const LinearLaw                 *linear; ///< the same object; null for another law
    };
    const Entry &
    entry(int region) const;

    void
    add_loads(const scene::Scene &scene, const mesh::TetMesh &mesh);

    std::vector<scene::MaterialParameters>                       materials;
    std::map<int, Entry>                                         entries;
    std::shared_ptr<VolumeDensity>                               temperatures;
    std::map<unsigned int, std::shared_ptr<const VolumeDensity>> forces;
    bool                                                         thermal = false;
    bool                                                         mixed   = false;
  };
} // namespace tetradapt::mechanics

#endif
