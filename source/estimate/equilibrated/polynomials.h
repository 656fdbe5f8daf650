// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_equilibrated_polynomials_h
#define tetradapt_estimate_equilibrated_polynomials_h

#include "tetradapt/mesh/edges.h"
#include "tetradapt/mesh/face_table.h"

namespace tetradapt::estimate
{
  /** Barycentric coordinates in a tetrahedron or in a part of one. */
  using Coordinates = std::array<double, 4>;

  /**
   * Alfeld's split of the unit tetrahedron (corners 0, e_x, e_y, e_z) from its
   * centroid. Part i has the corners of face i, in the order of mesh::face_vertices,
   * and the centroid as the last one; its volume is 1/24.
   */
  struct AlfeldSplit
  {
    /** Corner 0 to 3, or 4: the centroid. */
    static dealii::Point<3>
    corner(unsigned int number);

    static std::array<unsigned int, 4>
    part_corners(unsigned int part)
    {
      const auto &face = mesh::face_vertices[part];
      return {{face[0], face[1], face[2], 4}};
    }

    /** Gradients of the barycentric coordinates of a part. */
    static std::array<dealii::Tensor<1, 3>, 4>
    part_gradients(unsigned int part);

    /** Coordinates in a part from those in the tetrahedron, and back. */
    static Coordinates
    to_part(unsigned int part, const Coordinates &b);
    static Coordinates
    from_part(unsigned int part, const Coordinates &b);
  };

  /**
   * Polynomials of degree 2 or 3 on a part of the split, orthonormal with respect to
   * the unit tetrahedron's volume; the first ten are those of degree 2.
   */
  class PartPolynomials
  {
  public:
    explicit PartPolynomials(unsigned int degree);

    /** 10 or 20. */
    unsigned int
    size() const
    {
      return powers.size();
    }

    /** Value and derivatives by the part's coordinates @p b of one of them. */
    double
    value(unsigned int i, const Coordinates &b) const;
    Coordinates
    derivatives(unsigned int i, const Coordinates &b) const;

  private:
    std::vector<std::array<unsigned int, 4>> powers; ///< of the monomials
    std::vector<std::vector<double>>         rows;   ///< a polynomial's monomials
  };
} // namespace tetradapt::estimate

#endif
