/* Cameras through libcamera: which there are, opening, closing, and the door to C. */
#include "capture_libcamera.hpp"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include <dirent.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>

namespace capture_libcamera
{

/* ---- The one manager ----------------------------------------------------------------------- */

static std::mutex manager_lock;
static libcamera::CameraManager *the_manager;
static unsigned manager_shares;

/* libcamera talks on standard error unless told not to; statuses say what matters here. */
static void choose_log()
{
    if (!std::getenv("LIBCAMERA_LOG_LEVELS") && !std::getenv("LIBCAMERA_LOG_FILE")) {
        libcamera::logSetTarget(libcamera::LoggingTargetNone);
    }
}

int manager_share::take()
{
    const std::lock_guard<std::mutex> guard(manager_lock);

    if (manager) {
        return 0;
    }
    if (manager_shares == 0) {
        choose_log();
        std::unique_ptr<libcamera::CameraManager> made(new libcamera::CameraManager);
        const int result = made->start();

        if (result < 0) {
            return result;
        }
        the_manager = made.release();
    }
    manager_shares++;
    manager = the_manager;
    return 0;
}

void manager_share::keep_forever()
{
    const std::lock_guard<std::mutex> guard(manager_lock);

    if (manager) {
        manager_shares++;
    }
}

manager_share::~manager_share()
{
    const std::lock_guard<std::mutex> guard(manager_lock);

    if (manager && --manager_shares == 0) {
        the_manager->stop();
        delete the_manager;
        the_manager = nullptr;
    }
}

/* ---- Statuses ------------------------------------------------------------------------------ */

capture_status status_of(int result)
{
    switch (-result) {
    case EBUSY:
        return CAPTURE_ERR_BUSY;
    case EACCES:
    case EPERM:
        return CAPTURE_ERR_ACCESS;
    case ENODEV:
    case ENXIO:
        return CAPTURE_ERR_GONE;
    default:
        return CAPTURE_ERR_SYSTEM;
    }
}

capture_status fail_with(capture *camera, const char *what, int result)
{
    const state *const s = state_of(camera);
    const std::string text = std::generic_category().message(-result);

    return capture_fail(camera, status_of(result), "%s: %s: %s",
                        s && !s->id.empty() ? s->id.c_str() : "libcamera", what, text.c_str());
}

/* ---- Which cameras there are --------------------------------------------------------------- */

#if LIBCAMERA_VERSION_MAJOR == 0 && LIBCAMERA_VERSION_MINOR == 0
/* Before 0.1 the properties do not name the nodes, but the manager knows whose a node is. */
std::vector<dev_t> nodes_of(const manager_share &manager,
                            const std::shared_ptr<libcamera::Camera> &camera)
{
    static const char folder[] = "/sys/class/video4linux";
    std::vector<dev_t> nodes;
    DIR *const entries = opendir(folder);

    if (!entries) {
        return nodes;
    }
    while (const struct dirent *const entry = readdir(entries)) {
        const std::string path = std::string(folder) + "/" + entry->d_name + "/dev";
        FILE *const file = std::fopen(path.c_str(), "re");
        unsigned major = 0;
        unsigned minor = 0;

        if (!file) {
            continue;
        }
        if (std::fscanf(file, "%u:%u", &major, &minor) == 2) {
            const dev_t node = makedev(major, minor);

            if (manager->get(node) == camera) {
                nodes.push_back(node);
            }
        }
        std::fclose(file);
    }
    closedir(entries);
    return nodes;
}
#else
std::vector<dev_t> nodes_of(const manager_share &, const std::shared_ptr<libcamera::Camera> &camera)
{
    std::vector<dev_t> nodes;
    const auto devices = camera->properties().get(libcamera::properties::SystemDevices);

    if (devices) {
        for (const int64_t device : *devices) {
            nodes.push_back(static_cast<dev_t>(device));
        }
    }
    return nodes;
}
#endif

static std::string model_of(const libcamera::Camera &camera)
{
    const auto model = camera.properties().get(libcamera::properties::Model);

    return model ? std::string(*model) : camera.id();
}

static int list(const struct v4l2_calls *, capture_device *devices, size_t max)
{
    manager_share manager;
    size_t count = 0;

    if (manager.take() < 0) {
        return CAPTURE_ERR_SYSTEM;
    }
    for (const std::shared_ptr<libcamera::Camera> &camera : manager->cameras()) {
        if (count < max) {
            capture_device *const device = &devices[count];
            const std::string model = model_of(*camera);

            std::memset(device, 0, sizeof *device);
            capture_copy_text(device->path, sizeof device->path, camera->id().c_str(),
                              camera->id().size());
            capture_copy_text(device->card, sizeof device->card, model.c_str(), model.size());
            std::strcpy(device->driver, "libcamera");
            device->status = CAPTURE_OK;
        }
        count++;
    }
    return static_cast<int>(count);
}

/* How well a camera fits a wish: 3 its id or node, 2 its model, 1 a part of those, 0 not. */
static int fit_of(const manager_share &manager, const std::shared_ptr<libcamera::Camera> &camera,
                  const std::string &wanted)
{
    const std::string model = model_of(*camera);
    struct stat node;

    if (camera->id() == wanted) {
        return 3;
    }
    if (wanted.compare(0, 5, "/dev/") == 0 && stat(wanted.c_str(), &node) == 0) {
        for (const dev_t own : nodes_of(manager, camera)) {
            if (S_ISCHR(node.st_mode) && own == node.st_rdev) {
                return 3;
            }
        }
    }
    if (model == wanted) {
        return 2;
    }
    return camera->id().find(wanted) != std::string::npos || model.find(wanted) != std::string::npos
               ? 1
               : 0;
}

static capture_status find_camera(capture *camera)
{
    state *const s = state_of(camera);
    const auto cameras = s->manager->cameras();
    const char *const wanted = camera->wish.device;
    int best = 0;
    int alike = 0;

    if (cameras.empty()) {
        return capture_fail(camera, CAPTURE_ERR_NONE,
                            "libcamera finds no camera (is there one, and may this user open "
                            "/dev/media* and /dev/video*?)");
    }
    if (!wanted) {
        s->camera = cameras.front();
        return CAPTURE_OK;
    }
    for (const auto &candidate : cameras) {
        const int fit = fit_of(s->manager, candidate, wanted);

        alike = fit > best ? 1 : alike + (fit == best);
        if (fit > best) {
            best = fit;
            s->camera = candidate;
        }
    }
    if (best == 0) {
        return capture_fail(camera, CAPTURE_ERR_NONE, "libcamera has no camera %s", wanted);
    }
    if (alike > 1) {
        return capture_fail(camera, CAPTURE_ERR_NONE, "%d cameras are called %s", alike, wanted);
    }
    return CAPTURE_OK;
}

/* ---- Opening and closing ------------------------------------------------------------------- */

static void describe(capture *camera)
{
    const state *const s = state_of(camera);
    capture_settings *const settings = &camera->settings;
    const std::string model = model_of(*s->camera);

    capture_copy_text(settings->path, sizeof settings->path, s->id.c_str(), s->id.size());
    capture_copy_text(settings->card, sizeof settings->card, model.c_str(), model.size());
    std::strcpy(settings->driver, "libcamera");
}

static capture_status open_camera(capture *camera)
{
    state *const s = state_of(camera);
    int result = s->manager.take();

    if (result < 0) {
        return fail_with(camera, "starting the camera manager", result);
    }
    const capture_status found = find_camera(camera);
    if (found != CAPTURE_OK) {
        return found;
    }
    s->id = s->camera->id();
    s->nodes = nodes_of(s->manager, s->camera);
    describe(camera);
    result = s->camera->acquire();
    if (result < 0) {
        return fail_with(camera, "acquire", result);
    }
    s->acquired = true;
    s->camera->disconnected.connect(s, &state::unplugged);
    s->camera->requestCompleted.connect(s, &state::completed);
    return negotiate(camera);
}

static void close(capture *camera)
{
    state *const s = state_of(camera);

    if (s) {
        release_camera(s);
        delete s;
        camera->state = nullptr;
    }
}

static capture_status open(capture *camera)
{
    camera->state = new state;
    const capture_status status = open_camera(camera);

    /* A camera that is in use elsewhere can still be asked what it has. */
    camera->looking = status == CAPTURE_ERR_BUSY;
    if (status < 0 && !camera->looking) {
        close(camera);
    }
    return status;
}

/* ---- The door to C ------------------------------------------------------------------------- */

extern "C" {

static capture_status door_open(capture *camera)
{
    return guarded(camera, [&] { return open(camera); });
}

static void door_close(capture *camera)
{
    guarded(nullptr, [&] {
        close(camera);
        return CAPTURE_OK;
    });
}

static capture_status door_start(capture *camera)
{
    return guarded(camera, [&] { return start(camera); });
}

static capture_status door_stop(capture *camera)
{
    return guarded(camera, [&] { return stop(camera); });
}

static capture_status door_next(capture *camera, unsigned deadline_ms, capture_frame *frame)
{
    return guarded(camera, [&] { return next(camera, deadline_ms, frame); });
}

static capture_status door_give_back(capture *camera, const capture_frame *frame)
{
    return guarded(camera, [&] { return give_back(camera, frame); });
}

static int door_controls(capture *camera, capture_control *array, size_t max)
{
    return guarded(camera, [&] { return controls(camera, array, max); });
}

static capture_status door_menu_item(capture *camera, uint32_t id, int32_t index, char text[32])
{
    return guarded(camera, [&] { return menu_item(camera, id, index, text); });
}

static capture_status door_query(capture *camera, uint32_t id, capture_control *control)
{
    return guarded(camera, [&] { return query(camera, id, control); });
}

static capture_status door_get(capture *camera, uint32_t id, int32_t *value)
{
    return guarded(camera, [&] { return get(camera, id, value); });
}

static capture_status door_set(capture *camera, uint32_t id, int32_t value)
{
    return guarded(camera, [&] { return set(camera, id, value); });
}

static uint32_t door_known(capture *camera, capture_known wanted)
{
    uint32_t id = 0;

    guarded(camera, [&] {
        id = known(camera, wanted);
        return CAPTURE_OK;
    });
    return id;
}

static int door_modes(capture *camera, capture_mode *array, size_t max)
{
    return guarded(camera, [&] { return modes(camera, array, max); });
}

static int door_list(const struct v4l2_calls *calls, capture_device *devices, size_t max)
{
    return guarded(nullptr, [&] { return list(calls, devices, max); });
}

const struct capture_ops *capture_libcamera_ops(void)
{
    static const struct capture_ops ops = {
        door_open,      door_close,    door_start,     door_stop,  door_next,
        door_give_back, door_controls, door_menu_item, door_query, door_get,
        door_set,       door_known,    door_modes,     door_list,
    };

    return &ops;
}

} // extern "C"

} // namespace capture_libcamera
