// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_hierarchical_surplus_h
#define tetradapt_estimate_hierarchical_surplus_h

#include "tetradapt/mechanics/supports.h"
#include "tetradapt/mesh/nodal_field.h"

namespace tetradapt::estimate
{
  using dealii::Point;
  using dealii::Tensor;

  /** A number for every face of a mesh, and where its boundary faces lie. */
  struct FaceNumbers
  {
    unsigned int                             n_faces = 0;
    std::vector<std::array<unsigned int, 4>> cell_faces; ///< per cell, in mesh::face_vertices order
    /** Per entry of TetMesh::faces: 4 times its cell plus its local face there. */
    std::vector<unsigned int> boundary_slots;
  };

  /** Numbers the faces of a finalized mesh. Linear in the number of cells. */
  FaceNumbers
  number_faces(const mesh::TetMesh &mesh);

  /**
   * The functions that make the continuous piecewise polynomials of degree p = 1 or
   * 2 those of degree p + 1: with those of degree p they are a hierarchical basis.
   * With the barycentric coordinates b they are
   *
   * - for p = 1 one function an edge, 4 b_i b_j, which is 1 in the middle;
   * - for p = 2 one an edge, 6 sqrt(3) b_i b_j (b_i - b_j), odd about the middle and at
   *   most 1, and then one a face, 27 b_i b_j b_k, which is 1 in its centre.
   *
   * All of them are zero where the degrees of freedom of degree p are, so the nodal
   * values of a sum are those of its part of degree p. Odd functions point from the
   * larger to the smaller point number of their edge; a cell that sees the edge the
   * other way round has the sign -1 for it.
   */
  class HierarchicalSurplus
  {
  public:
    static constexpr unsigned int max_per_cell = 10;
    static constexpr double       odd_scale    = 10.392304845413264; ///< 6 sqrt(3)
    static constexpr double       face_scale   = 27.;

    /** For the space of @p field; shares its mesh and edges. */
    explicit HierarchicalSurplus(const mesh::NodalField &field);

    /** p, the degree that is enriched. */
    unsigned int
    degree() const
    {
      return polynomial_degree;
    }
    const mesh::TetMesh &
    mesh() const
    {
      return *mesh_pointer;
    }
    const mesh::EdgeTable &
    edges() const
    {
      return *edge_pointer;
    }
    const FaceNumbers &
    faces() const
    {
      return face_numbers;
    }
    /** Edges; for p = 2 edges and faces, edges first. */
    unsigned int
    n_functions() const
    {
      return edge_pointer->edges.size() + (polynomial_degree == 2 ? face_numbers.n_faces : 0);
    }
    /** 6 or 10: edges in mesh::edge_vertices order, then faces in mesh::face_vertices
     * order. */
    unsigned int
    n_per_cell() const
    {
      return polynomial_degree == 1 ? 6 : 10;
    }
    /** Number of function @p i of @p cell. */
    unsigned int
    function(unsigned int cell, unsigned int i) const
    {
      return i < 6 ? edge_pointer->cell_edges[cell][i]
                   : edge_pointer->edges.size() + face_numbers.cell_faces[cell][i - 6];
    }
    /** What values() and gradients() must be multiplied by in @p cell. */
    std::array<double, max_per_cell>
    signs(unsigned int cell) const
    {
      std::array<double, max_per_cell> result;
      result.fill(1.);
      if (polynomial_degree == 2)
        for (unsigned int e = 0; e < 6; ++e)
          if (mesh_pointer->cells[cell][mesh::edge_vertices[e][0]]
              > mesh_pointer->cells[cell][mesh::edge_vertices[e][1]])
            result[e] = -1.;
      return result;
    }

    /** The n_per_cell() functions at @p b, as if every sign were 1. */
    static void
    values(unsigned int degree, const mesh::Barycentric &b, double *values);

    /** Their gradients, from those of the barycentric coordinates. */
    static void
    gradients(unsigned int                       degree,
              const mesh::Barycentric           &b,
              const std::array<Tensor<1, 3>, 4> &directions,
              Tensor<1, 3>                      *gradients);

  private:
    std::shared_ptr<const mesh::TetMesh>   mesh_pointer;
    std::shared_ptr<const mesh::EdgeTable> edge_pointer;
    FaceNumbers                            face_numbers;
    unsigned int                           polynomial_degree;
  };

  /**
   * The coefficients of the functions that live on supports: what the prescribed
   * displacement has beyond its interpolation of degree p, which is zero for
   * displacements of that degree. On an edge its value in the middle (p = 1) or the
   * odd part of its values at the thirds (p = 2), on a face its value in the centre.
   * One entry a function. Where faces slide, the same of the normal displacement, along the normals
   * of the place as those of a node there: where these vary, the spaces of the two degrees differ
   * by as much as the wall differs from the mesh.
   * @throws core::InputError for a rigid support.
   */
  mechanics::PrescribedDisplacement
  prescribe_surplus(const std::vector<scene::SupportParameters> &supports,
                    const HierarchicalSurplus                   &surplus,
                    const scene::MeshParameters                 &surface = {});
} // namespace tetradapt::estimate

#endif
