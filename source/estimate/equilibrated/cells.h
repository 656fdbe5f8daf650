// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_equilibrated_cells_h
#define tetradapt_estimate_equilibrated_cells_h

#include "tetradapt/mechanics/material_map.h"
#include "tetradapt/mechanics/volume_density.h"
#include "tetradapt/mesh/nodal_field.h"
#include "tetradapt/scene/scene.h"

#include <deal.II/lac/full_matrix.h>

namespace tetradapt::estimate
{
  using dealii::Point;
  using dealii::SymmetricTensor;
  using dealii::Tensor;

  struct CellBatch;
  struct CellFaces;

  /** Stress and body force in a cell. The functions are b_i, then 4 b_i b_k in the
   * order of mesh::edge_vertices. */
  struct CellState
  {
    double                                volume;
    std::array<Tensor<1, 3>, 4>           gradients; ///< of the barycentric coordinates
    std::array<SymmetricTensor<2, 3>, 10> stress;    ///< coefficients of the functions
    std::array<Tensor<1, 3>, 10>          force;     ///< int body force times function
    std::array<Tensor<1, 3>, 4>           density;   ///< body force, linear, at the corners
    /** What a quadratic body force has beyond that: coefficients of
     * EquilibratedElement::orthogonal_bubble(). */
    std::array<Tensor<1, 3>, 6> curvature;

    bool   has_bubbles;         ///< whether stress has coefficients beyond the fourth
    bool   has_curvature;       ///< whether the body force is more than linear
    double force_oscillation;   ///< L2 norm of the body force minus its quadratic part
    double thermal_oscillation; ///< energy norm of the thermal strain minus its quadratic part
  };

  /** b_i, then 4 b_i b_k in the order of mesh::edge_vertices. */
  std::array<double, 10>
  quadratic_functions(const mesh::Barycentric &b);

  /** Integrals over face @p f of the cell of its traction stress * outer normal
   * times l_0, l_1, l_2, 4 l_0 l_1, 4 l_1 l_2, 4 l_2 l_0 of its corners. */
  void
  traction_moments(const CellState &state, unsigned int f, Tensor<1, 3> *moments);

  /** From moments against 4 l_s l_(s+1) to those against these functions made
   * orthogonal to l_0, l_1 and l_2; see EquilibratedElement::n_moments. */
  template <typename Number>
  void
  make_orthogonal(Number *moments)
  {
    for (unsigned int s = 0; s < 3; ++s)
      moments[3 + s] -= .6 * (moments[s] + moments[(s + 1) % 3]) - .2 * moments[(s + 2) % 3];
  }

  /** int stress : grad(function) - int force * function, for the first @p n
   * functions: the work that the tractions on the cell's faces have to do on them. */
  void
  unbalanced_moments(const CellState &state, unsigned int n, Tensor<1, 3> *moments);

  /** Gives the state of each cell under a displacement. */
  class CellStates
  {
  public:
    /** The arguments must outlive this object. */
    CellStates(const mesh::NodalField &u_h, const mechanics::MaterialMap &materials);

    void
    compute(unsigned int cell, CellState &state) const;

    /** The same without the stress; in mixed form, without thermal_oscillation, which is zero then,
     * as a thermal strain has no finite stress in a fully incompressible material. */
    void
    compute_loads(unsigned int cell, CellState &state) const;

    /**
     * Puts a cell into a lane of @p batch: its shape and material, and as loads what
     * an equilibrated stress has beyond the state's stress: the tractions with
     * moments @p moments (18 a face, see FaceTractions), minus the stress's, and
     * body force plus the stress's divergence.
     */
    void
    load(unsigned int               cell,
         const CellState           &state,
         const CellFaces           &faces,
         const std::vector<double> &moments,
         CellBatch                 &batch,
         unsigned int               lane) const;

    /** stress : C^-1 : stress of a cell's material for a stress of norm one: the
     * largest there is in an isotropic material, and that of simple tension. */
    double
    largest_compliance(unsigned int cell) const
    {
      return region(cell).largest_compliance;
    }
    double
    tension_compliance(unsigned int cell) const
    {
      return region(cell).compliance[0][0];
    }

    /** Whether a body force or a temperature is not constant in a cell's region. */
    bool
    has_variable_loads(unsigned int cell) const
    {
      return region(cell).thermal || !region(cell).variable_forces.empty();
    }

  private:
    struct Region
    {
      const laws::LinearLaw *law;
      double                 compliance[6][6]; ///< xx, yy, zz, yz, zx, xy
      double                 largest_compliance;
      Tensor<1, 3>           constant_force;
      bool                   thermal;

      std::vector<const mechanics::VolumeDensity *> variable_forces;
    };

    const Region &
    region(unsigned int cell) const
    {
      return regions.find(mesh.regions[cell])->second;
    }
    Region
    make_region(int id) const;
    void
    load_shape(unsigned int cell, double J, CellBatch &batch, unsigned int lane) const;
    void
    compute_stress(unsigned int cell, const Region &region, CellState &state) const;
    void
    add_thermal_stress(unsigned int cell, const Region &region, CellState &state) const;
    void
    compute_force(unsigned int cell, const Region &region, CellState &state) const;
    void
    add_variable_force(unsigned int                    cell,
                       const mechanics::VolumeDensity &force,
                       CellState                      &state) const;
    /** The quadratic polynomial with given means of products with the functions, as
     * coefficients of these. */
    template <typename Value>
    std::array<Value, 10>
    polynomial_with(const std::array<Value, 10> &means) const;

    const mesh::NodalField                   &u_h;
    const mesh::TetMesh                      &mesh;
    const mechanics::MaterialMap             &materials;
    std::map<int, Region>                     regions;
    dealii::FullMatrix<double>                inverse_products; ///< of the functions' mean products
    mutable mechanics::VolumeDensity::Samples samples;          ///< work space
  };
} // namespace tetradapt::estimate

#endif
