// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_adapt_mesh_maker_h
#define tetradapt_adapt_mesh_maker_h

#include "tetradapt/adapt/mesh_record.h"
#include "tetradapt/adapt/size_field.h"
#include "tetradapt/core/log.h"
#include "tetradapt/mesh/boundary_projection.h"
#include "tetradapt/mesh/tetgen.h"

#include <mpi.h>

namespace tetradapt::adapt
{
  /** A mesh of a run, and how it came out. */
  struct NewMesh
  {
    std::shared_ptr<const mesh::TetMesh> mesh;
    MeshRecord                           record; ///< on the first rank
    /** Part of the body's volume that the projection of the boundary swept. */
    double swept = 0.;
  };

  /**
   * Makes the meshes of a run, on the first rank, and gives them to all. Whatever made
   * it, a mesh's boundary is projected where the scene asks for that, before it is
   * given away. All functions are collective.
   */
  class MeshMaker
  {
  public:
    /** Keeps references. @throws core::InputError for a projection that cannot be. */
    MeshMaker(const scene::Scene &scene, MPI_Comm communicator, const core::Log &log);

    /** Mesh @p number of those that the scene lists, refined to its Mesh/Size field. */
    NewMesh
    initial(unsigned int number);

    /** @p old refined by TetGen. @param locator of @p old. */
    NewMesh
    refined(const mesh::TetMesh &old, const SizeField &field, const compare::PointLocator &locator);

    /** The body that @p old fills meshed from scratch with the sizes of @p field; refined
     * instead, with a warning, where its boundary does not allow that. */
    NewMesh
    made_from_scratch(const mesh::TetMesh         &old,
                      const SizeField             &field,
                      const compare::PointLocator &locator,
                      const mesh::EdgeTable       &edges);

    /** Every tetrahedron of @p old cut into eight. @param edges may be null. */
    NewMesh
    uniform(const mesh::TetMesh &old, const mesh::EdgeTable *edges);

  private:
    NewMesh
    make(const std::function<mesh::TetMesh(NewMesh &)> &how, bool project);
    mesh::TetMesh
    initial_mesh(unsigned int number, NewMesh &made);
    mesh::TetMesh
    refine(const mesh::TetMesh &old, const SizeField &field) const;
    mesh::TetMesh
    mesh_from_scratch(const mesh::TetMesh   &old,
                      const SizeField       &field,
                      const mesh::EdgeTable &edges) const;
    void
    compare_with_true_volume(const mesh::TetMesh &mesh) const;

    const scene::Scene                             &scene;
    MPI_Comm                                        communicator;
    const core::Log                                &log;
    mesh::Tetgen                                    tetgen;
    std::unique_ptr<const mesh::BoundaryProjection> projection;        ///< first rank; may be null
    double                                          first_volume = 0.; ///< first rank
    double                                          body_volume  = 0.; ///< first rank
    unsigned int                                    n_parts      = 0;  ///< first rank
  };
} // namespace tetradapt::adapt

#endif
