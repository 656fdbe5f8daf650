// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_tetgen_protocol_h
#define tetradapt_mesh_tetgen_protocol_h

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

/**
 * What the program and its TetGen child process say to each other. Both are
 * built from this header and run on one machine, so numbers travel in the
 * machine's own representation. A message is a Header followed by
 * Header::payload_size bytes: the fields of a TetgenRequest or a TetgenReply.
 *
 * The child is plain C++ without deal.II, so that it starts in milliseconds:
 * keep this header free of everything but the standard library.
 */
namespace tetradapt::mesh
{
  /** Opens every message. The child needs the limits before it may allocate. */
  struct TetgenHeader
  {
    static constexpr std::uint64_t current_magic = 0x3130'4754'4441'5454; // "TTADTG01"

    std::uint64_t magic        = current_magic;
    std::uint64_t memory_limit = 0; ///< bytes of address space; 0: unlimited
    std::uint64_t cpu_limit    = 0; ///< seconds of processor time; 0: unlimited
    std::uint64_t payload_size = 0; ///< bytes that follow
  };

  /** One call of TetGen. Empty lists are not passed on. Numbering is from 0. */
  struct TetgenRequest
  {
    std::string               switches;
    std::vector<double>       points;         ///< three a point
    std::vector<double>       point_sizes;    ///< edge length, one a point
    std::vector<std::int32_t> facet_offsets;  ///< where each facet's polygon starts, and the end
    std::vector<std::int32_t> facet_vertices; ///< the polygons' corners
    std::vector<std::int32_t> facet_markers;  ///< one a facet
    std::vector<double>       regions;        ///< x y z id volume, five a region
    std::vector<std::int32_t> tets;           ///< four a tetrahedron
    std::vector<double>       tet_attributes; ///< region id, one a tetrahedron
    std::vector<double>       tet_volumes;    ///< bound, one a tetrahedron; <= 0: none
    std::vector<std::int32_t> faces;          ///< three a boundary triangle
    std::vector<std::int32_t> face_markers;   ///< one a triangle, > 0
    std::vector<std::int32_t> edges;          ///< two an edge that must be kept
  };

  /** How a call ended, as far as the child could tell. */
  enum class TetgenStatus : std::int32_t
  {
    done          = 0,
    tetgen_error  = 1, ///< TetGen gave up; the reply has its code
    out_of_memory = 2,
    bad_request   = 3 ///< the request contradicts itself
  };

  /** The mesh, or why there is none. */
  struct TetgenReply
  {
    TetgenStatus              status      = TetgenStatus::done;
    std::int32_t              tetgen_code = 0; ///< what TetGen passed to terminatetetgen()
    std::string               message;
    std::vector<double>       points;         ///< three a point
    std::vector<std::int32_t> tets;           ///< four a tetrahedron
    std::vector<double>       tet_attributes; ///< one a tetrahedron, or empty
    std::vector<std::int32_t> faces;          ///< three a triangle
    std::vector<std::int32_t> face_markers;   ///< one a triangle
  };

  /** Appends values to a byte string. */
  class TetgenWriter
  {
  public:
    template <typename T>
    void
    operator()(const std::vector<T> &values)
    {
      append(values.data(), values.size(), sizeof(T));
    }
    void
    operator()(const std::string &text)
    {
      append(text.data(), text.size(), 1);
    }
    void
    operator()(std::int32_t value)
    {
      append(&value, 1, sizeof(value));
    }

    std::string bytes;

  private:
    void
    append(const void *data, std::uint64_t count, std::size_t size)
    {
      bytes.append(reinterpret_cast<const char *>(&count), sizeof(count));
      if (count > 0)
        bytes.append(static_cast<const char *>(data), count * size);
    }
  };

  /** Takes values out of a byte string in the order in which they were put in. */
  class TetgenReader
  {
  public:
    /** Reads @p bytes, which must outlive the reader, from @p position on. */
    explicit TetgenReader(const std::string &bytes, std::size_t position = 0)
      : bytes(bytes), position(position)
    {
    }

    template <typename T>
    void
    operator()(std::vector<T> &values)
    {
      values.resize(next_count(sizeof(T)));
      take(values.data(), values.size() * sizeof(T));
    }
    void
    operator()(std::string &text)
    {
      text.resize(next_count(1));
      take(text.data(), text.size());
    }
    void
    operator()(std::int32_t &value)
    {
      if (next_count(sizeof(value)) != 1)
        throw std::runtime_error("a message between the program and TetGen is malformed");
      take(&value, sizeof(value));
    }
    bool
    at_end() const
    {
      return position == bytes.size();
    }

  private:
    /** Number of items that follow; never more than there are bytes for. */
    std::uint64_t
    next_count(std::size_t size)
    {
      std::uint64_t count = 0;
      take(&count, sizeof(count));
      if (count > (bytes.size() - position) / size)
        throw std::runtime_error("a message between the program and TetGen is truncated");
      return count;
    }
    void
    take(void *data, std::size_t size)
    {
      if (size > bytes.size() - position)
        throw std::runtime_error("a message between the program and TetGen is truncated");
      if (size > 0)
        std::memcpy(data, bytes.data() + position, size);
      position += size;
    }

    const std::string &bytes;
    std::size_t        position;
  };

  /** Applies @p archive, a TetgenWriter or a TetgenReader, to every field. */
  template <typename Archive, typename Request>
  void
  transfer_request(Archive &archive, Request &request)
  {
    archive(request.switches);
    archive(request.points);
    archive(request.point_sizes);
    archive(request.facet_offsets);
    archive(request.facet_vertices);
    archive(request.facet_markers);
    archive(request.regions);
    archive(request.tets);
    archive(request.tet_attributes);
    archive(request.tet_volumes);
    archive(request.faces);
    archive(request.face_markers);
    archive(request.edges);
  }

  inline void
  write_reply(TetgenWriter &writer, const TetgenReply &reply)
  {
    writer(static_cast<std::int32_t>(reply.status));
    writer(reply.tetgen_code);
    writer(reply.message);
    writer(reply.points);
    writer(reply.tets);
    writer(reply.tet_attributes);
    writer(reply.faces);
    writer(reply.face_markers);
  }

  inline void
  read_reply(TetgenReader &reader, TetgenReply &reply)
  {
    std::int32_t status = 0;
    reader(status);
    reply.status = static_cast<TetgenStatus>(status);
    reader(reply.tetgen_code);
    reader(reply.message);
    reader(reply.points);
    reader(reply.tets);
    reader(reply.tet_attributes);
    reader(reply.faces);
    reader(reply.face_markers);
  }
} // namespace tetradapt::mesh

#endif
