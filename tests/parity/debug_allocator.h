#pragma once
/// An allocator for drivers that counts the allocations they hold.

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <mutex>
#include <unordered_map>

#include <vulkan/vulkan.hpp>

namespace nusselt::parity {

/// Pass it to gpu::DeviceOptions. In such memory, drivers may keep their part of each Vulkan object (buffers, device
/// memory, images, pipelines, ...). Some drivers allocate nothing here; live() shows that.
class DebugAllocator {
public:
    DebugAllocator() : callbacks_(this, allocate, reallocate, release) {}
    // Drivers keep the address of the allocator.
    DebugAllocator(const DebugAllocator&) = delete;
    DebugAllocator& operator=(const DebugAllocator&) = delete;

    const vk::AllocationCallbacks* callbacks() const { return &callbacks_; }
    /// Number of allocations that have not been released.
    std::size_t live() const {
        const std::lock_guard lock(mutex_);
        return sizes_.size();
    }
    /// Lets the next `count` allocations succeed. All later ones fail until the next call.
    void allow(std::size_t count) {
        const std::lock_guard lock(mutex_);
        allowed_ = count;
    }
    void allow_all() { allow(std::numeric_limits<std::size_t>::max()); }

private:
    static void* VKAPI_CALL allocate(void* self, std::size_t size, std::size_t alignment,
                                     VkSystemAllocationScope) {
        return static_cast<DebugAllocator*>(self)->allocate(size, alignment);
    }
    static void* VKAPI_CALL reallocate(void* self, void* old, std::size_t size, std::size_t alignment,
                                       VkSystemAllocationScope) {
        auto& allocator = *static_cast<DebugAllocator*>(self);
        void* const pointer = size > 0 ? allocator.allocate(size, alignment) : nullptr;
        if (size > 0 && pointer == nullptr) return nullptr; // the old allocation stays valid
        if (old != nullptr && pointer != nullptr)
            std::memcpy(pointer, old, std::min(size, allocator.size_of(old)));
        allocator.release(old);
        return pointer;
    }
    static void VKAPI_CALL release(void* self, void* pointer) {
        static_cast<DebugAllocator*>(self)->release(pointer);
    }

    void* allocate(std::size_t size, std::size_t alignment) {
        const std::lock_guard lock(mutex_);
        if (allowed_ == 0) return nullptr;
        --allowed_;
        alignment = std::max(alignment, alignof(std::max_align_t));
        void* const pointer = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
        if (pointer != nullptr) sizes_[pointer] = size;
        return pointer;
    }
    std::size_t size_of(void* pointer) const {
        const std::lock_guard lock(mutex_);
        return sizes_.at(pointer);
    }
    void release(void* pointer) {
        const std::lock_guard lock(mutex_);
        sizes_.erase(pointer);
        std::free(pointer);
    }

    vk::AllocationCallbacks callbacks_;
    mutable std::mutex mutex_;
    std::unordered_map<void*, std::size_t> sizes_;
    std::size_t allowed_ = std::numeric_limits<std::size_t>::max();
};

} // namespace nusselt::parity
