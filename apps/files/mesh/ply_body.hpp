// The values behind a PLY header, one after another, from text or from bytes of either order.
#pragma once

#include <cstdint>
#include <memory>

#include "files/mesh/ply_header.hpp"

namespace app {

class PlyBody {
 public:
  virtual ~PlyBody() = default;
  // A row starts, and ends: then none of its values may be left. `place` stays until the next row.
  virtual void begin_row(Place place) = 0;
  virtual void end_row() {}
  virtual double real(PlyType type) = 0;
  virtual std::int64_t whole(PlyType type) = 0;
  virtual void skip(PlyType type, std::int64_t count) = 0;
  // The length of a list, whose values are all there.
  virtual std::int64_t length(const PlyProperty& list) = 0;
  // Behind the last row there must be nothing.
  virtual void end() = 0;

  virtual std::size_t bytes_left() const = 0;
  const Place& place() const { return place_; }
  virtual std::string text() const { return ""; }  // of the row, in quotes, for messages

 protected:
  Place place_{};
};

std::unique_ptr<PlyBody> make_ply_body(const PlyHeader& header, const MeshBuilder& mesh);

}  // namespace app
