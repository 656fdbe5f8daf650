// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_springs_h
#define tetradapt_mechanics_springs_h

#include "tetradapt/fem/field.h"
#include "tetradapt/mechanics/resultant.h"
#include "tetradapt/scene/scene.h"

#include <deal.II/base/symmetric_tensor.h>

#include <memory>
#include <string>
#include <vector>

namespace tetradapt::mechanics
{
  /**
   * The elastic foundations of a scene on the boundary faces of one mesh (Winkler's): supports of
   * type spring, whose traction on the body is -K (u - u0) with K = k I or, along the normal n
   * only, K = k n n^T, and u0 the displacement of the ground. n is that of the surface which the
   * boundary is projected on, else that of the face.
   *
   * All that integrates over the springs takes the points that are here, on each face the same
   * for the matrix of each degree: so that of degree 1 is that of degree 2 in the subspace, and
   * the energy of the springs never negative. They are as many as k and k u0 need
   * (DensitySampler), at least seven, which are exact for constants times products of degree 5.
   *
   * One object is to be used by one thread.
   */
  class Springs
  {
  public:
    /** A point of the rule of one face. */
    struct Sample
    {
      std::array<double, 3>         b;      ///< barycentric, of the face's vertices
      double                        weight; ///< those of a face sum to its area
      dealii::SymmetricTensor<2, 3> stiffness;
      dealii::Tensor<1, 3>          ground; ///< u0

      /** Force per area on the body. */
      dealii::Tensor<1, 3>
      traction(const dealii::Tensor<1, 3> &displacement) const
      {
        return stiffness * (ground - displacement);
      }
    };

    /** The springs of one support on one face. */
    struct Face
    {
      unsigned int        face;    ///< of the mesh's boundary faces
      unsigned int        support; ///< of the scene's supports
      std::vector<Sample> points;
    };

    /** Keeps a reference to the mesh, whose patches name the supports. Looks at the springs of all
     * faces; does nothing if there are none in the scene.
     * @throws core::InputError if a stiffness is negative somewhere or zero on all faces. */
    Springs(const scene::Scene &scene, const mesh::TetMesh &mesh);
    ~Springs();

    bool
    empty() const
    {
      return face_springs.empty();
    }

    /** Sorted by faces. */
    const std::vector<Face> &
    faces() const
    {
      return face_springs;
    }

    /** Of the scene, of all types. */
    unsigned int
    n_supports() const
    {
      return support_count;
    }

    /** Those on boundary face @p face: a range of faces(). */
    std::pair<std::vector<Face>::const_iterator, std::vector<Face>::const_iterator>
    on_face(unsigned int face) const;

    bool
    act_on(const unsigned int face) const
    {
      const auto range = on_face(face);
      return range.first != range.second;
    }

    /** The sum of their tractions on a boundary face at any point of it or of the surface over
     * it. @param normal there, outward, of length one: along it springs with a direction act. */
    dealii::Tensor<1, 3>
    traction(unsigned int                face,
             const dealii::Point<3>     &point,
             const dealii::Tensor<1, 3> &normal,
             const dealii::Tensor<1, 3> &displacement) const;

    /** Whether a ground may have a displacement other than zero. */
    bool
    have_moved_ground() const
    {
      return moved;
    }

    /** What to tell about how well the stiffness could be looked at; empty: nothing. */
    const std::vector<std::string> &
    remarks() const
    {
      return all_remarks;
    }

    const mesh::TetMesh &
    tet_mesh() const
    {
      return mesh;
    }

  private:
    struct Foundation;

    void
    sample(const scene::Scene &scene);
    void
    check_stiffness(const scene::Scene &scene) const;

    const mesh::TetMesh                     &mesh;
    std::vector<std::unique_ptr<Foundation>> foundations; ///< one a spring support
    std::vector<Face>                        face_springs;
    std::vector<std::string>                 all_remarks;
    unsigned int                             support_count;
    bool                                     moved = false;
  };

  /** Values of the 3 or 6 Lagrange functions of a face of degree 1 or 2: of its vertices, then of
   * its edges in the order (0,1) (1,2) (2,0). */
  void
  face_shape_values(unsigned int degree, const std::array<double, 3> &b, double *values);

  /** What springs do to a body that is displaced. */
  struct SpringForces
  {
    std::vector<Resultant> supports; ///< one a support of the scene, zero where it has no springs
    fem::Vector            nodal;    ///< int N_i t on the nodes; of no size if there are no springs
    double                 magnitude = 0.; ///< sum of the lengths of these
    double                 energy    = 0.; ///< 1/2 int (u - u0) . K (u - u0)
  };

  /** The forces of @p springs at @p displacement, on the same mesh. Collective: each rank takes
   * the faces that have a node of its own. What is not nodal is the same on every rank. */
  SpringForces
  spring_forces(const Springs &springs, const fem::Field &displacement);

  /** What to tell the user about the springs of a scene on a mesh: where they act along the
   * normals of flat faces that stand for a curved surface; and where they are so stiff or so
   * soft that rounding spoils digits. "Supports/base/Direction: ..." each.
   * @throws core::InputError if they hold the body so softly that no digit of its stress is left.
   */
  std::vector<std::string>
  check_springs(const scene::Scene &scene, const mesh::TetMesh &mesh);
} // namespace tetradapt::mechanics

#endif
