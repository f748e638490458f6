#include "fake_libcamera.hpp"

#include <cerrno>
#include <cstring>

#include <sys/mman.h>
#include <unistd.h>

fake_script script;
fake_account account;
std::deque<libcamera::Request *> fake_queue;
std::map<unsigned, libcamera::ControlValue> fake_start_controls, fake_request_controls;

static std::shared_ptr<libcamera::Camera> fake_camera;
static libcamera::Stream *fake_stream();
static uint64_t fake_time_ns;

namespace libcamera
{

/* ---- The manager --------------------------------------------------------------------------- */

class CameraManager::Private : public Extensible::Private
{
};

CameraManager *CameraManager::self_ = nullptr;

CameraManager::CameraManager() : Extensible(std::make_unique<Private>())
{
    account.faults += account.managers != 0;
    account.managers++;
}

CameraManager::~CameraManager()
{
    account.managers--;
}

int CameraManager::start()
{
    if (script.manager_start == 0 && script.present) {
        fake_return();
    }
    return script.manager_start;
}

void CameraManager::stop()
{
    fake_camera.reset();
    account.faults += account.cameras != 0; /* somebody still holds it */
}

std::vector<std::shared_ptr<Camera>> CameraManager::cameras() const
{
    return fake_camera ? std::vector<std::shared_ptr<Camera>>{fake_camera}
                       : std::vector<std::shared_ptr<Camera>>{};
}

std::shared_ptr<Camera> CameraManager::get(const std::string &id)
{
    return fake_camera && fake_camera->id() == id ? fake_camera : nullptr;
}

std::shared_ptr<Camera> CameraManager::get(dev_t)
{
    return nullptr;
}

/* ---- The camera ---------------------------------------------------------------------------- */

class Camera::Private : public Extensible::Private
{
  public:
    std::string id;
    ControlInfoMap controls;
    ControlList properties;
    std::set<Stream *> streams;
    bool acquired = false;
    bool running = false;
    bool gone = false;
};

class FakeConfiguration : public CameraConfiguration
{
  public:
    Status validate() override;
};

static unsigned planes_of(const StreamConfiguration &stream)
{
    return stream.pixelFormat == formats::NV12 ? 2 : stream.pixelFormat == formats::YUV420 ? 3 : 1;
}

static unsigned bytes_of(const StreamConfiguration &stream, unsigned plane)
{
    const unsigned luma = stream.stride * stream.size.height;

    return plane == 0 ? luma : planes_of(stream) == 2 ? luma / 2 : luma / 4;
}

CameraConfiguration::Status FakeConfiguration::validate()
{
    StreamConfiguration &stream = config_[0];
    const auto found = script.formats.find(stream.pixelFormat);
    Status status = Valid;

    if (found == script.formats.end()) {
        stream.pixelFormat = script.formats.begin()->first;
        status = Adjusted;
    }
    const std::vector<SizeRange> &ranges = script.formats.at(stream.pixelFormat);
    Size size = ranges.back().max;

    for (const SizeRange &range : ranges) {
        size = range.contains(stream.size) ? stream.size : size;
    }
    status = size == stream.size ? status : Adjusted;
    stream.size = size;
    const bool planar = planes_of(stream) > 1;
    const bool three = stream.pixelFormat == formats::BGR888;
    const unsigned row = size.width * (planar ? 1U : three ? 3U : 2U);

    stream.stride = (row + script.stride_step - 1) / script.stride_step * script.stride_step;
    stream.frameSize = 0;
    for (unsigned i = 0; i < planes_of(stream); i++) {
        stream.frameSize += bytes_of(stream, i);
    }
    return status;
}

Camera::Camera(std::unique_ptr<Private> d, const std::string &id, const std::set<Stream *> &streams)
    : Extensible(std::move(d))
{
    _d()->id = id;
    _d()->streams = streams;
    _d()->controls = ControlInfoMap(ControlInfoMap::Map(script.controls), controls::controls);
    _d()->properties = ControlList(properties::properties);
    account.cameras++;
}

Camera::~Camera()
{
    account.faults += _d()->acquired;
    account.cameras--;
}

std::shared_ptr<Camera> Camera::create(std::unique_ptr<Private> d, const std::string &id,
                                       const std::set<Stream *> &streams)
{
    return std::shared_ptr<Camera>(new Camera(std::move(d), id, streams),
                                   [](Camera *camera) { delete camera; });
}

const std::string &Camera::id() const
{
    return _d()->id;
}

int Camera::acquire()
{
    if (script.acquire != 0 || _d()->acquired || _d()->gone) {
        return script.acquire != 0 ? script.acquire : _d()->gone ? -ENODEV : -EBUSY;
    }
    _d()->acquired = true;
    account.acquired++;
    return 0;
}

int Camera::release()
{
    account.faults += _d()->running || !_d()->acquired;
    _d()->acquired = false;
    account.acquired--;
    return 0;
}

const ControlInfoMap &Camera::controls() const
{
    return _d()->controls;
}

const ControlList &Camera::properties() const
{
    return _d()->properties;
}

std::unique_ptr<CameraConfiguration> Camera::generateConfiguration(const StreamRoles &roles)
{
    if (roles.size() != 1 || roles[0] == StreamRole::Raw) {
        return nullptr;
    }
    auto made = std::make_unique<FakeConfiguration>();
    StreamConfiguration stream{StreamFormats(script.formats)};

    stream.pixelFormat = script.formats.begin()->first;
    stream.size = script.formats.begin()->second.back().max;
    made->addConfiguration(stream);
    made->validate();
    return made;
}

int Camera::configure(CameraConfiguration *config)
{
    account.faults += !_d()->acquired || _d()->running;
    config->at(0).setStream(fake_stream());
    fake_stream()->configuration_ = config->at(0);
    return script.configure;
}

std::unique_ptr<Request> Camera::createRequest(uint64_t cookie)
{
    return std::make_unique<Request>(this, cookie);
}

int Camera::queueRequest(Request *request)
{
    account.faults += !_d()->running && !_d()->gone;
    if (_d()->gone || script.queue != 0) {
        return _d()->gone ? -ENODEV : script.queue;
    }
    fake_queue.push_back(request);
    fake_request_controls.clear();
    for (const auto &each : request->controls()) {
        fake_request_controls[each.first] = each.second;
    }
    return 0;
}

int Camera::start(const ControlList *controls)
{
    account.faults += _d()->running || !fake_queue.empty();
    if (_d()->gone || script.start != 0) {
        return _d()->gone ? -ENODEV : script.start;
    }
    fake_start_controls.clear();
    if (controls) {
        for (const auto &each : *controls) {
            fake_start_controls[each.first] = each.second;
        }
    }
    _d()->running = true;
    account.running++;
    account.starts++;
    return 0;
}

int Camera::stop()
{
    if (!_d()->running) {
        return 0;
    }
    _d()->running = false;
    account.running--;
    account.stops++;
    while (!fake_queue.empty()) {
        fake_deliver(0, FrameMetadata::FrameCancelled);
    }
    return 0;
}

/* As libcamera does: the camera counts as stopped, its requests are never finished. */
void Camera::disconnect()
{
    if (_d()->running) {
        _d()->running = false;
        account.running--;
    }
    _d()->gone = true;
    fake_queue.clear();
    disconnected.emit();
}

/* ---- Requests and buffers ------------------------------------------------------------------ */

class Request::Private : public Extensible::Private
{
};

Request::Request(Camera *camera, uint64_t cookie)
    : Extensible(std::make_unique<Private>()), controls_(new ControlList(camera->controls())),
      metadata_(new ControlList(controls::controls)), cookie_(cookie), status_(RequestPending)
{
    account.requests++;
}

Request::~Request()
{
    for (const Request *queued : fake_queue) {
        account.faults += queued == this;
    }
    account.requests--;
    delete controls_;
    delete metadata_;
}

void Request::reuse(ReuseFlag flags)
{
    account.faults += flags != ReuseBuffers;
    status_ = RequestPending;
    controls_->clear();
    metadata_->clear();
}

int Request::addBuffer(const Stream *stream, FrameBuffer *buffer, std::unique_ptr<Fence>)
{
    bufferMap_[stream] = buffer;
    return 0;
}

/* The one member of Request that may set its status from outside: the tests' way in. */
FrameBuffer *Request::findBuffer(const Stream *stream) const
{
    const bool cancelled =
        bufferMap_.at(stream)->metadata().status == FrameMetadata::FrameCancelled;

    const_cast<Request *>(this)->status_ = cancelled ? RequestCancelled : RequestComplete;
    return bufferMap_.at(stream);
}

class FrameBuffer::Private : public Extensible::Private
{
  public:
    std::vector<Plane> planes;
    FrameMetadata metadata = {};
};

FrameBuffer::FrameBuffer(const std::vector<Plane> &planes, unsigned int)
    : Extensible(std::make_unique<Private>())
{
    _d()->planes = planes;
    _d()->metadata.planes_.resize(planes.size());
    account.buffers++;
}

const std::vector<FrameBuffer::Plane> &FrameBuffer::planes() const
{
    return _d()->planes;
}

const FrameMetadata &FrameBuffer::metadata() const
{
    return _d()->metadata;
}

FrameBufferAllocator::FrameBufferAllocator(std::shared_ptr<Camera> camera)
    : camera_(std::move(camera))
{
}

FrameBufferAllocator::~FrameBufferAllocator()
{
    for (const auto &each : buffers_) {
        account.faults += account.requests != 0; /* they name the buffers */
        account.buffers -= static_cast<int>(each.second.size());
    }
}

static std::unique_ptr<FrameBuffer> make_buffer(const StreamConfiguration &stream)
{
    const int fd = memfd_create("fake", MFD_CLOEXEC);
    std::vector<FrameBuffer::Plane> planes;
    unsigned offset = 0;

    if (ftruncate(fd, static_cast<off_t>(stream.frameSize)) != 0) {
        account.faults++;
    }
    const SharedFD shared(fd); /* a duplicate */
    ::close(fd);
    for (unsigned i = 0; i < planes_of(stream); i++) {
        FrameBuffer::Plane plane;

        plane.fd = shared;
        plane.offset = offset;
        plane.length = bytes_of(stream, i);
        offset += plane.length;
        planes.push_back(plane);
    }
    if (script.one_plane) {
        planes.resize(1);
        planes[0].length = offset;
    }
    return std::make_unique<FrameBuffer>(planes);
}

int FrameBufferAllocator::allocate(Stream *stream)
{
    if (script.allocate != 0) {
        return script.allocate;
    }
    for (unsigned i = 0; i < stream->configuration().bufferCount; i++) {
        buffers_[stream].push_back(make_buffer(stream->configuration()));
    }
    return static_cast<int>(buffers_[stream].size());
}

const std::vector<std::unique_ptr<FrameBuffer>> &FrameBufferAllocator::buffers(Stream *stream) const
{
    return buffers_.at(stream);
}

} // namespace libcamera

/* ---- The test's side ----------------------------------------------------------------------- */

static libcamera::Stream *fake_stream()
{
    static libcamera::Stream stream;

    return &stream;
}

bool fake_deliver(uint32_t sequence, libcamera::FrameMetadata::Status status, unsigned bytes_less,
                  const libcamera::ControlList *metadata)
{
    if (fake_queue.empty() || !fake_camera) {
        return false;
    }
    libcamera::Request *const request = fake_queue.front();
    libcamera::FrameBuffer *const buffer = request->buffers().at(fake_stream());
    auto &filled = const_cast<libcamera::FrameMetadata &>(buffer->metadata());
    const auto &planes = buffer->planes();
    const auto byte = static_cast<uint8_t>(sequence);

    fake_queue.pop_front();
    filled.status = status;
    filled.sequence = sequence;
    filled.timestamp = fake_time_ns += 1000000;
    for (size_t i = 0; i < planes.size(); i++) {
        filled.planes()[i].bytesused = planes[i].length;
    }
    filled.planes()[planes.size() - 1].bytesused -= bytes_less;
    if (pwrite(planes[0].fd.get(), &byte, 1, 0) != 1) {
        account.faults++;
    }
    if (metadata) {
        request->metadata().merge(*metadata);
    }
    request->findBuffer(fake_stream());
    fake_camera->requestCompleted.emit(request);
    return true;
}

/* libcamera's own name for it: a class that Camera lets in. */
namespace libcamera
{
class PipelineHandler
{
  public:
    static void unplug(Camera *camera)
    {
        camera->disconnect();
    }
};
} // namespace libcamera

void fake_unplug()
{
    const std::shared_ptr<libcamera::Camera> leaving = std::move(fake_camera);

    fake_camera.reset();
    libcamera::PipelineHandler::unplug(leaving.get());
}

void fake_return()
{
    fake_camera = libcamera::Camera::create(std::make_unique<libcamera::Camera::Private>(),
                                            "fake/camera.0", {fake_stream()});
}
