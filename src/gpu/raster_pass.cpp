#include "gpu/raster_pass.h"

#include "gpu/shader_stage.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <string>
#include <utility>

namespace nusselt::gpu {

namespace {

constexpr vk::Format kNumberFormat = vk::Format::eR32Uint;
constexpr vk::Format kDepthFormat = vk::Format::eD32Sfloat;

std::string size_name(const vk::Extent2D& size) {
    return std::to_string(size.width) + " x " + std::to_string(size.height) + " pixels";
}

vk::raii::Image make_image(const Device& device, vk::Format format, vk::ImageUsageFlags usage,
                           const vk::Extent2D& size) {
    const std::string name = device.description().name + ": an image of " + size_name(size);
    const vk::PhysicalDeviceLimits& limits = device.limits();
    const std::uint32_t width =
        std::min({limits.maxImageDimension2D, limits.maxFramebufferWidth, limits.maxViewportDimensions[0]});
    const std::uint32_t height =
        std::min({limits.maxImageDimension2D, limits.maxFramebufferHeight, limits.maxViewportDimensions[1]});
    if (size.width > width || size.height > height)
        throw Error(name + " exceeds the limit of " + size_name({width, height}) + "; use a smaller image");
    const vk::ImageCreateInfo info({}, vk::ImageType::e2D, format, {size.width, size.height, 1}, 1, 1,
                                   vk::SampleCountFlagBits::e1, vk::ImageTiling::eOptimal, usage);
    return guarded(name, [&] { return vk::raii::Image(device.handle(), info); });
}

vk::raii::ImageView make_view(const Device& device, const vk::raii::Image& image,
                              const vk::raii::DeviceMemory& memory, vk::Format format,
                              vk::ImageAspectFlags aspect) {
    image.bindMemory(*memory, 0);
    return {device.handle(),
            vk::ImageViewCreateInfo({}, *image, vk::ImageViewType::e2D, format, {}, {aspect, 0, 1, 0, 1})};
}

vk::AttachmentDescription cleared_attachment(vk::Format format, vk::AttachmentStoreOp store,
                                             vk::ImageLayout final_layout) {
    return {{},
            format,
            vk::SampleCountFlagBits::e1,
            vk::AttachmentLoadOp::eClear,
            store,
            vk::AttachmentLoadOp::eDontCare,
            vk::AttachmentStoreOp::eDontCare,
            vk::ImageLayout::eUndefined,
            final_layout};
}

vk::raii::RenderPass make_render_pass(const Device& device) {
    using Layout = vk::ImageLayout;
    const std::array attachments = {
        cleared_attachment(kNumberFormat, vk::AttachmentStoreOp::eStore, Layout::eTransferSrcOptimal),
        cleared_attachment(kDepthFormat, vk::AttachmentStoreOp::eDontCare,
                           Layout::eDepthStencilAttachmentOptimal)};
    const vk::AttachmentReference numbers(0, Layout::eColorAttachmentOptimal);
    const vk::AttachmentReference depth(1, Layout::eDepthStencilAttachmentOptimal);
    const vk::SubpassDescription subpass({}, vk::PipelineBindPoint::eGraphics, {}, numbers, {}, &depth);
    using Stage = vk::PipelineStageFlagBits;
    using Access = vk::AccessFlagBits;
    const std::array dependencies = {
        // The passes and copies of frames before.
        vk::SubpassDependency(VK_SUBPASS_EXTERNAL, 0, Stage::eAllCommands,
                              Stage::eColorAttachmentOutput | Stage::eEarlyFragmentTests,
                              Access::eMemoryWrite,
                              Access::eColorAttachmentWrite | Access::eDepthStencilAttachmentRead |
                                  Access::eDepthStencilAttachmentWrite),
        vk::SubpassDependency(0, VK_SUBPASS_EXTERNAL, Stage::eColorAttachmentOutput, Stage::eTransfer,
                              Access::eColorAttachmentWrite, Access::eTransferRead)};
    return {device.handle(), vk::RenderPassCreateInfo({}, attachments, subpass, dependencies)};
}

vk::raii::PipelineLayout make_layout(const Device& device, const ShaderBindings& bindings,
                                     std::uint32_t push_constant_size) {
    const vk::PushConstantRange push(vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment, 0,
                                     push_constant_size);
    const std::vector<vk::DescriptorSetLayout> sets = bindings.layouts();
    vk::PipelineLayoutCreateInfo info({}, sets);
    if (push_constant_size > 0) info.setPushConstantRanges(push);
    return {device.handle(), info};
}

vk::raii::Pipeline make_pipeline(const Device& device, std::span<const std::uint32_t> vertex,
                                 std::span<const std::uint32_t> fragment, const RasterInterface& interface,
                                 vk::PipelineLayout layout, vk::RenderPass render_pass) {
    const ShaderStage stages[] = {
        {device, vk::ShaderStageFlagBits::eVertex, vertex, interface.constants},
        {device, vk::ShaderStageFlagBits::eFragment, fragment, interface.constants}};
    const std::array descriptions = {stages[0].description(), stages[1].description()};
    const vk::PipelineVertexInputStateCreateInfo no_input;
    const vk::PipelineInputAssemblyStateCreateInfo assembly({}, vk::PrimitiveTopology::eTriangleList);
    const vk::PipelineViewportStateCreateInfo viewports({}, 1, nullptr, 1, nullptr);
    const std::array sizes = {vk::DynamicState::eViewport, vk::DynamicState::eScissor};
    const vk::PipelineDynamicStateCreateInfo dynamic({}, sizes);
    vk::PipelineRasterizationStateCreateInfo rasterization;
    rasterization.cullMode = vk::CullModeFlagBits::eNone;
    rasterization.lineWidth = 1;
    const vk::PipelineMultisampleStateCreateInfo one_sample;
    const vk::PipelineDepthStencilStateCreateInfo depth({}, true, true, vk::CompareOp::eGreater);
    vk::PipelineColorBlendAttachmentState replaced;
    replaced.colorWriteMask = vk::ColorComponentFlagBits::eR;
    const vk::PipelineColorBlendStateCreateInfo blend({}, false, vk::LogicOp::eCopy, replaced);
    const vk::GraphicsPipelineCreateInfo info({}, descriptions, &no_input, &assembly, nullptr, &viewports,
                                              &rasterization, &one_sample, &depth, &blend, &dynamic, layout,
                                              render_pass);
    return {device.handle(), nullptr, info};
}

/// A key of everything on which a compiled pipeline depends. All passes have compatible render passes.
std::string key_of(std::span<const std::uint32_t> vertex, std::span<const std::uint32_t> fragment,
                   const RasterInterface& interface) {
    std::string key;
    for (const std::span<const std::uint32_t> spirv : {vertex, fragment}) {
        append_to_key(key, spirv.size());
        key.append(reinterpret_cast<const char*>(spirv.data()), spirv.size_bytes());
    }
    for (const std::uint64_t number :
         {std::uint64_t{interface.storage_buffers},
          std::uint64_t{interface.images == nullptr ? 0 : interface.images->count() + 1},
          std::uint64_t{interface.push_constant_size}})
        append_to_key(key, number);
    for (const std::uint32_t constant : interface.constants) append_to_key(key, constant);
    return key;
}

vk::raii::Framebuffer make_framebuffer(const Device& device, vk::RenderPass render_pass,
                                       vk::ImageView numbers, vk::ImageView depth, const vk::Extent2D& size) {
    const std::array views = {numbers, depth};
    return {device.handle(), vk::FramebufferCreateInfo({}, render_pass, views, size.width, size.height, 1)};
}

/// Throws Error if there is no way to draw.
const Device& checked(const Device& device) {
    if (!device.draws())
        throw Error(device.description().name +
                    ": the device does not support drawing; choose another one with NUSSELT_DEVICE");
    return device;
}

} // namespace

RasterPass::Target::Target(const Device& device, vk::Format format, vk::ImageUsageFlags usage,
                           vk::ImageAspectFlags aspect, vk::Extent2D size)
    : image(make_image(device, format, usage, size)),
      memory(device.allocate(image.getMemoryRequirements(), vk::MemoryPropertyFlagBits::eDeviceLocal)),
      view(make_view(device, image, memory, format, aspect)) {}

RasterPass::RasterPass(const Device& device, std::span<const std::uint32_t> vertex,
                       std::span<const std::uint32_t> fragment, const RasterInterface& interface,
                       std::uint32_t width, std::uint32_t height) try
    : push_constant_size_(interface.push_constant_size),
      size_{width, height},
      numbers_(checked(device), kNumberFormat,
               vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc,
               vk::ImageAspectFlagBits::eColor, size_),
      depth_(device, kDepthFormat, vk::ImageUsageFlagBits::eDepthStencilAttachment,
             vk::ImageAspectFlagBits::eDepth, size_),
      render_pass_(make_render_pass(device)),
      framebuffer_(make_framebuffer(device, *render_pass_, *numbers_.view, *depth_.view, size_)),
      bindings_(device, interface.storage_buffers, 0, interface.images,
                vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment),
      shader_(&device.shaders().get(key_of(vertex, fragment, interface), [&] {
          vk::raii::PipelineLayout layout = make_layout(device, bindings_, interface.push_constant_size);
          vk::raii::Pipeline pipeline =
              make_pipeline(device, vertex, fragment, interface, *layout, *render_pass_);
          return CompiledShader{std::move(layout), std::move(pipeline)};
      })) {
} catch (const vk::SystemError& error) {
    rethrow(device.description().name + ": preparing to draw " + size_name({width, height}), error);
}

void RasterPass::draw(const Device::Commands& commands, std::span<const std::byte> push,
                      std::uint32_t vertices, const Buffer& numbers) const {
    assert(push.size() == push_constant_size_);
    assert(numbers.size() >= sizeof(std::uint32_t) * size_.width * size_.height);
    const std::array<vk::ClearValue, 2> clear = {
        vk::ClearColorValue(std::array<std::uint32_t, 4>{0, 0, 0, 0}), vk::ClearDepthStencilValue(0, 0)};
    commands.beginRenderPass(
        vk::RenderPassBeginInfo(*render_pass_, *framebuffer_, vk::Rect2D({}, size_), clear),
        vk::SubpassContents::eInline);
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *shader_->pipeline);
    commands.setViewport(
        0, vk::Viewport(0, 0, static_cast<float>(size_.width), static_cast<float>(size_.height), 0, 1));
    commands.setScissor(0, vk::Rect2D({}, size_));
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *shader_->layout, 0, bindings_.handles(),
                                {});
    if (!push.empty())
        commands.pushConstants<std::byte>(
            *shader_->layout, vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment, 0,
            vk::ArrayProxy<const std::byte>(static_cast<std::uint32_t>(push.size()), push.data()));
    commands.draw(vertices, 1, 0, 0);
    commands.endRenderPass();
    const vk::BufferImageCopy whole(0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {},
                                    {size_.width, size_.height, 1});
    commands.copyImageToBuffer(*numbers_.image, vk::ImageLayout::eTransferSrcOptimal, numbers.handle(),
                               whole);
}

} // namespace nusselt::gpu
