// SPDX-License-Identifier: AGPL-3.0-or-later

// tetradapt-tetgen: runs TetGen once, in a process of its own.
//
// TetGen keeps global state, crashes on bad input and may not come to an end;
// here it can do so without harm to the program that asked. One request is
// read from standard input, one reply written to standard output (see
// tetgen_protocol.h); whatever TetGen prints goes to standard error.

#include "tetradapt/mesh/tetgen_protocol.h"

#include "terminate.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <limits>
#include <memory>
#include <new>

#define TETLIBRARY
#include <tetgen.h>

namespace
{
  using namespace tetradapt::mesh;

  int reply_descriptor = STDOUT_FILENO;

  void
  read_all(void *data, std::size_t size)
  {
    char *position = static_cast<char *>(data);
    while (size > 0)
      {
        const ssize_t n = read(STDIN_FILENO, position, size);
        if (n < 0 && errno == EINTR)
          continue;
        if (n <= 0)
          throw std::runtime_error("the request ends early");
        position += n;
        size -= n;
      }
  }

  void
  write_all(const char *data, std::size_t size)
  {
    while (size > 0)
      {
        const ssize_t n = write(reply_descriptor, data, size);
        if (n < 0 && errno == EINTR)
          continue;
        if (n <= 0)
          _exit(1); // nobody listens any more
        data += n;
        size -= n;
      }
  }

  void
  send_reply(const TetgenReply &reply)
  {
    TetgenWriter writer;
    write_reply(writer, reply);
    TetgenHeader header;
    header.payload_size = writer.bytes.size();
    write_all(reinterpret_cast<const char *>(&header), sizeof(header));
    write_all(writer.bytes.data(), writer.bytes.size());
  }

  /** Sends a reply without a mesh and ends the process at once: after a failure
   * TetGen's data cannot be trusted to survive their destructors. */
  [[noreturn]] void
  send_failure(TetgenStatus status, int code, const char *message)
  {
    TetgenReply reply;
    reply.status      = status;
    reply.tetgen_code = code;
    reply.message     = message;
    send_reply(reply);
    _exit(0);
  }

  void
  tetgen_gave_up(int code)
  {
    if (code == 1)
      send_failure(TetgenStatus::out_of_memory, code, "");
    send_failure(TetgenStatus::tetgen_error, code, "");
  }

  void
  limit(int resource, rlim_t value)
  {
    rlimit limits;
    if (getrlimit(resource, &limits) != 0)
      return;
    if (limits.rlim_max != RLIM_INFINITY && value > limits.rlim_max)
      value = limits.rlim_max;
    limits.rlim_cur = value;
    setrlimit(resource, &limits);
  }

  /** Reads the header, applies its limits to this process, reads the rest. */
  TetgenRequest
  read_request()
  {
    TetgenHeader header;
    header.magic = 0;
    read_all(&header, sizeof(header));
    if (header.magic != TetgenHeader::current_magic)
      throw std::runtime_error("the request is not one of this program's version");
    limit(RLIMIT_CORE, 0);
    if (header.memory_limit > 0)
      limit(RLIMIT_AS, header.memory_limit);
    if (header.cpu_limit > 0)
      limit(RLIMIT_CPU, header.cpu_limit);

    std::string bytes;
    bytes.resize(header.payload_size);
    read_all(bytes.data(), bytes.size());
    TetgenRequest request;
    TetgenReader  reader(bytes);
    transfer_request(reader, request);
    if (!reader.at_end())
      throw std::runtime_error("the request is longer than its fields");
    return request;
  }

  void
  require(bool condition, const char *message)
  {
    if (!condition)
      throw std::runtime_error(message);
  }

  void
  check_indices(const std::vector<std::int32_t> &indices, std::size_t n_points)
  {
    for (const std::int32_t i : indices)
      require(i >= 0 && static_cast<std::size_t>(i) < n_points, "a point number is out of range");
  }

  void
  check_finite(const std::vector<double> &values)
  {
    for (const double x : values)
      require(std::isfinite(x), "a number is not finite");
  }

  /** TetGen takes the lengths of its lists on trust; so they are checked here. */
  void
  check_request(const TetgenRequest &r)
  {
    const std::size_t n_points = r.points.size() / 3, n_tets = r.tets.size() / 4;
    require(r.points.size() % 3 == 0 && n_points >= 4, "there are fewer than four points");
    require(n_points < static_cast<std::size_t>(std::numeric_limits<int>::max()) / 8
              && n_tets < static_cast<std::size_t>(std::numeric_limits<int>::max()) / 8,
            "the mesh is too large for TetGen");
    require(r.point_sizes.empty() || r.point_sizes.size() == n_points,
            "there is not one size a point");
    require(r.tets.size() % 4 == 0 && r.faces.size() % 3 == 0 && r.edges.size() % 2 == 0
              && r.regions.size() % 5 == 0,
            "a list has a wrong length");
    require(r.tet_attributes.empty() || r.tet_attributes.size() == n_tets,
            "there is not one region a tetrahedron");
    require(r.tet_volumes.empty() || r.tet_volumes.size() == n_tets,
            "there is not one volume bound a tetrahedron");
    require(r.face_markers.size() == r.faces.size() / 3, "there is not one marker a face");
    require(r.facet_offsets.size() == r.facet_markers.size() + (r.facet_offsets.empty() ? 0 : 1),
            "there is not one marker a facet");
    require(r.switches.size() < 500, "the switches are too long");
    for (std::size_t i = 1; i < r.facet_offsets.size(); ++i)
      require(r.facet_offsets[i] >= r.facet_offsets[i - 1] + 3, "a facet has no three corners");
    require(r.facet_offsets.empty()
              || (r.facet_offsets.front() == 0
                  && static_cast<std::size_t>(r.facet_offsets.back()) == r.facet_vertices.size()),
            "the facets do not match their corners");
    require(!r.tets.empty() || !r.facet_offsets.empty(), "there is nothing to mesh");
    for (const auto *list : {&r.facet_vertices, &r.tets, &r.faces, &r.edges})
      check_indices(*list, n_points);
    for (const auto *list :
         {&r.points, &r.point_sizes, &r.regions, &r.tet_attributes, &r.tet_volumes})
      check_finite(*list);
  }

  /** TetGen's input. It refers to the request's arrays, which TetGen only reads;
   * forget() takes them back before tetgenio's destructor frees them. */
  class Input
  {
  public:
    explicit Input(TetgenRequest &r)
    {
      io.firstnumber       = 0;
      io.pointlist         = r.points.data();
      io.numberofpoints    = r.points.size() / 3;
      io.pointmtrlist      = list(r.point_sizes);
      io.numberofpointmtrs = r.point_sizes.empty() ? 0 : 1;

      io.tetrahedronlist               = list(r.tets);
      io.numberoftetrahedra            = r.tets.size() / 4;
      io.numberofcorners               = 4;
      io.tetrahedronattributelist      = list(r.tet_attributes);
      io.numberoftetrahedronattributes = r.tet_attributes.empty() ? 0 : 1;
      io.tetrahedronvolumelist         = list(r.tet_volumes);

      io.trifacelist       = list(r.faces);
      io.trifacemarkerlist = list(r.face_markers);
      io.numberoftrifaces  = r.face_markers.size();
      io.edgelist          = list(r.edges);
      io.numberofedges     = r.edges.size() / 2;
      io.regionlist        = list(r.regions);
      io.numberofregions   = r.regions.size() / 5;
      add_facets(r);
    }

    Input(const Input &) = delete;
    Input &
    operator=(const Input &)
      = delete;

    ~Input()
    {
      io.initialize(); // all pointers back to null
    }

    tetgenio io;

  private:
    template <typename T>
    static T *
    list(std::vector<T> &values)
    {
      return values.empty() ? nullptr : values.data();
    }

    void
    add_facets(TetgenRequest &r)
    {
      const std::size_t n = r.facet_markers.size();
      polygons.resize(n);
      facets.resize(n);
      for (std::size_t i = 0; i < n; ++i)
        {
          polygons[i].vertexlist       = r.facet_vertices.data() + r.facet_offsets[i];
          polygons[i].numberofvertices = r.facet_offsets[i + 1] - r.facet_offsets[i];
          tetgenio::init(&facets[i]);
          facets[i].polygonlist      = &polygons[i];
          facets[i].numberofpolygons = 1;
        }
      io.facetlist       = list(facets);
      io.facetmarkerlist = list(r.facet_markers);
      io.numberoffacets  = n;
    }

    std::vector<tetgenio::polygon> polygons;
    std::vector<tetgenio::facet>   facets;
  };

  template <typename T, typename S>
  void
  copy(std::vector<T> &to, const S *from, std::size_t count)
  {
    if (from != nullptr)
      to.assign(from, from + count);
  }

  TetgenReply
  run(TetgenRequest &request)
  {
    check_request(request);
    Input    in(request);
    tetgenio out;
    tetrahedralize(request.switches.data(), &in.io, &out);

    TetgenReply reply;
    copy(reply.points, out.pointlist, 3 * static_cast<std::size_t>(out.numberofpoints));
    const std::size_t n_tets = out.numberoftetrahedra;
    copy(reply.tets, out.tetrahedronlist, 4 * n_tets);
    if (out.numberoftetrahedronattributes == 1)
      copy(reply.tet_attributes, out.tetrahedronattributelist, n_tets);
    const std::size_t n_faces = out.numberoftrifaces;
    copy(reply.faces, out.trifacelist, 3 * n_faces);
    copy(reply.face_markers, out.trifacemarkerlist, n_faces);
    return reply;
  }
} // namespace

int
main()
{
  // Die with the program that asked, even if it was killed.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  std::signal(SIGPIPE, SIG_IGN);
  reply_descriptor = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
  if (reply_descriptor < 0 || dup2(STDERR_FILENO, STDOUT_FILENO) < 0)
    return 1;
  tetradapt::tetgen_worker::set_give_up_handler(&tetgen_gave_up);

  try
    {
      TetgenRequest request = read_request();
      send_reply(run(request));
    }
  catch (const std::bad_alloc &)
    {
      send_failure(TetgenStatus::out_of_memory, 0, "");
    }
  catch (const std::exception &error)
    {
      send_failure(TetgenStatus::bad_request, 0, error.what());
    }
  catch (int code)
    {
      tetgen_gave_up(code);
    }
  // Freeing a large mesh block by block takes longer than ending.
  _exit(0);
}
