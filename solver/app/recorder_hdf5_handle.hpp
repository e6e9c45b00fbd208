// A small layer over the HDF5 C API: handles that close themselves, and calls that throw std::runtime_error.
#pragma once

#include <fmt/core.h>
#include <hdf5.h>

#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace hawser::hdf5 {

class Handle {
 public:
  using Close = herr_t (*)(hid_t);

  Handle() = default;
  Handle(hid_t id, Close close, const std::string& what) : id_(id), close_(close) {
    if (id < 0) throw std::runtime_error("HDF5: cannot " + what);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }

  operator hid_t() const { return id_; }

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

inline void check(herr_t status, const std::string& what) {
  if (status < 0) throw std::runtime_error("HDF5: cannot " + what);
}

inline Handle space(const std::vector<hsize_t>& size, const std::vector<hsize_t>& most) {
  return {H5Screate_simple(static_cast<int>(size.size()), size.data(), most.data()), H5Sclose, "describe an array"};
}

inline Handle create_group(hid_t where, const std::string& name) {
  const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, "create a property list");
  check(H5Pset_create_intermediate_group(links, 1), "set a property");
  return {H5Gcreate2(where, name.c_str(), links, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, "create group " + name};
}

inline void write_doubles(hid_t where, const std::string& name, std::span<const double> values) {
  const Handle shape = space({values.size()}, {values.size()});
  const Handle set(H5Dcreate2(where, name.c_str(), H5T_IEEE_F64LE, shape, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose, "create " + name);
  check(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "write " + name);
}

inline Handle text_type(const std::string& text) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "describe a text");
  check(H5Tset_size(type, text.size() + 1), "describe a text");
  check(H5Tset_cset(type, H5T_CSET_UTF8), "describe a text");
  return type;
}

inline void write_text(hid_t where, const std::string& name, const std::string& text) {
  const Handle type = text_type(text), shape(H5Screate(H5S_SCALAR), H5Sclose, "describe a text");
  const Handle set(H5Dcreate2(where, name.c_str(), type, shape, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose, "create " + name);
  check(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()), "write " + name);
}

/// Creates the attribute, or replaces it.
inline void set_attribute(hid_t where, const std::string& name, hid_t type, const void* value) {
  if (H5Aexists(where, name.c_str()) > 0) check(H5Adelete(where, name.c_str()), "replace " + name);
  const Handle shape(H5Screate(H5S_SCALAR), H5Sclose, "describe an attribute");
  const Handle attribute(H5Acreate2(where, name.c_str(), type, shape, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, "create " + name);
  check(H5Awrite(attribute, type, value), "write " + name);
}

inline void set_attribute(hid_t where, const std::string& name, const std::string& text) {
  set_attribute(where, name, text_type(text), text.c_str());
}

/// An array that grows along its first axis: `row` is the size of one entry, empty for a number.
class Growing {
 public:
  Growing(hid_t where, const std::string& name, std::vector<hsize_t> row) : name_(name), size_(std::move(row)) {
    size_.insert(size_.begin(), 0);
    std::vector<hsize_t> most = size_, chunk = size_;
    most[0] = H5S_UNLIMITED;
    chunk[0] = size_.size() == 1 ? 512 : 1;
    const Handle layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "create a property list");
    check(H5Pset_chunk(layout, static_cast<int>(chunk.size()), chunk.data()), "set a chunk size");
    set_ = Handle(H5Dcreate2(where, name.c_str(), H5T_IEEE_F64LE, space(size_, most), H5P_DEFAULT, layout, H5P_DEFAULT), H5Dclose, "create " + name);
  }

  void append(const double* row) {
    ++size_[0];
    check(H5Dset_extent(set_, size_.data()), "extend " + name_);
    std::vector<hsize_t> start(size_.size(), 0), count = size_;
    start[0] = size_[0] - 1;
    count[0] = 1;
    const Handle file_space(H5Dget_space(set_), H5Sclose, "read the size of " + name_);
    check(H5Sselect_hyperslab(file_space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr), "select a row of " + name_);
    check(H5Dwrite(set_, H5T_NATIVE_DOUBLE, space(count, count), file_space, H5P_DEFAULT, row), "write " + name_);
  }

 private:
  std::string name_;
  std::vector<hsize_t> size_;
  Handle set_;
};

/// A one-dimensional dataset, whole.
inline std::vector<double> read_doubles(hid_t where, const std::string& name) {
  const Handle set(H5Dopen2(where, name.c_str(), H5P_DEFAULT), H5Dclose, "find " + name);
  const Handle shape(H5Dget_space(set), H5Sclose, "read the size of " + name);
  std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(shape)));
  check(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "read " + name);
  return values;
}

}  // namespace hawser::hdf5
