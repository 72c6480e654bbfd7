// Arrays that are handed to the caller, or freed if the call fails before that.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>

namespace compat {

// From malloc, as Triangle's are.
template <class T>
class MallocArray {
public:
    MallocArray() = default;
    MallocArray(const MallocArray &) = delete;
    MallocArray &operator=(const MallocArray &) = delete;
    ~MallocArray() {
        if (is_own_) std::free(data_);
    }

    // The caller's array where there is one, as Triangle has it; otherwise one of its own. Throws std::bad_alloc.
    void allocate(T *given, std::size_t count) {
        data_ = given;
        if (given != nullptr) return;
        data_ = static_cast<T *>(std::malloc(count > 0 ? count * sizeof(T) : 1));
        if (data_ == nullptr) throw std::bad_alloc();
        is_own_ = true;
    }

    // Does nothing where nothing was allocated.
    void hand_over(T *&slot) {
        if (data_ == nullptr) return;
        slot = data_;
        is_own_ = false;
    }

    explicit operator bool() const { return data_ != nullptr; }
    T *data() const { return data_; }
    T &operator[](std::size_t i) const { return data_[i]; }

private:
    T *data_ = nullptr;
    bool is_own_ = false;
};

} // namespace compat
