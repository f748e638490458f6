/* Cameras through libcamera: buffers, requests, frames, and what goes wrong with them. */
#include "capture_libcamera.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>

#include <sys/sysmacros.h>
#include <unistd.h>

namespace capture_libcamera
{

/* How often to look whether an unplugged camera is back. */
static constexpr std::chrono::milliseconds look_again(20);
/* How long udev may take to tell that a camera's nodes have vanished. */
static constexpr std::chrono::milliseconds announcement(300);

/* ---- libcamera's thread -------------------------------------------------------------------- */

void state::completed(libcamera::Request *request)
{
    {
        const std::lock_guard<std::mutex> guard(lock);

        finished.push_back(static_cast<unsigned>(request->cookie()));
    }
    wake.notify_one();
}

void state::unplugged()
{
    {
        const std::lock_guard<std::mutex> guard(lock);

        gone = true;
    }
    wake.notify_one();
}

/* ---- Starting and stopping ----------------------------------------------------------------- */

static bool is_gone(state *s)
{
    const std::lock_guard<std::mutex> guard(s->lock);

    return s->gone;
}

/* Says whether a device node of the camera has vanished: libcamera learns of that through udev
 * only, and of some cameras never. */
static bool nodes_vanished(const state *s)
{
    for (const dev_t node : s->nodes) {
        char path[64];

        std::snprintf(path, sizeof path, "/sys/dev/char/%u:%u", major(node), minor(node));
        if (access(path, F_OK) != 0 && errno == ENOENT) {
            return true;
        }
    }
    return false;
}

static int queue(state *s, slot *queued)
{
    queued->number = s->next_number++;
    queued->request->reuse(libcamera::Request::ReuseBuffers);
    carry_controls(s, &queued->request->controls(), queued->number, false);
    queued->where = place::queued;
    const int result = s->camera->queueRequest(queued->request.get());
    if (result < 0) {
        queued->where = place::idle;
    }
    return result;
}

/* Starts the camera and gives it every buffer that the caller does not hold. */
static int run(state *s)
{
    libcamera::ControlList list(s->camera->controls());

    carry_controls(s, &list, s->next_number, true);
    int result = s->camera->start(&list);
    if (result < 0) {
        return result;
    }
    s->running = true;
    s->sequence_known = false;
    s->timeouts_in_row = 0;
    for (slot &each : s->slots) {
        if (each.where == place::idle) {
            result = queue(s, &each);
            if (result < 0) {
                return result;
            }
        }
    }
    return 0;
}

/* A call that libcamera's thread answers only after all it was given before. */
class rendezvous : public libcamera::Object
{
  public:
    void meet()
    {
    }
};

static void settle_messages(const std::shared_ptr<libcamera::Camera> &camera)
{
    auto *const point = new rendezvous;

    point->moveToThread(camera->thread());
    point->invokeMethod(&rendezvous::meet, libcamera::ConnectionTypeBlocking);
    point->deleteLater();
}

/* The word from udev may come a little after the nodes have gone. */
static bool is_announced(state *s)
{
    std::unique_lock<std::mutex> guard(s->lock);

    return s->wake.wait_for(guard, announcement, [s] { return s->gone; });
}

static bool is_stranded(const state *s)
{
    return s->camera && s->stranded.lock() == s->camera;
}

/*
 * After this no request is libcamera's any more.
 *
 * A camera that vanished without libcamera's knowledge cannot be stopped: Camera::stop() finds
 * requests that can never be finished and aborts the program, and so does the end of a camera whose
 * image processing still runs. It is left as it is, in the manager's list, and the manager lives as
 * long as the program.
 */
static void halt(state *s)
{
    if (s->running) {
        s->running = false;
        const bool vanished = nodes_vanished(s);

        if (is_gone(s) || (vanished && is_announced(s))) {
            settle_messages(s->camera);
        } else if (vanished) {
            settle_messages(s->camera);
            s->stranded = s->camera;
            s->manager.keep_forever();
        } else {
            s->camera->stop();
        }
    }
    const std::lock_guard<std::mutex> guard(s->lock);
    s->finished.clear();
    for (slot &each : s->slots) {
        if (each.where == place::queued) {
            each.where = place::idle;
        }
    }
}

void release_camera(state *s)
{
    if (s->acquired) {
        halt(s);
        s->camera->requestCompleted.disconnect(s);
        s->camera->disconnected.disconnect(s);
    }
    drop_slots(s);
    s->config.reset();
    if (s->acquired && !is_stranded(s)) {
        s->camera->release();
    }
    s->acquired = false;
    s->camera.reset();
}

capture_status start(capture *camera)
{
    state *const s = state_of(camera);

    if (s->lost || s->away || is_gone(s)) {
        return fail_with(camera, "start", -ENODEV);
    }
    s->carry_on = false;
    s->last_timestamp_us = 0;
    s->missed = 0;
    const capture_status status = make_slots(camera);
    if (status != CAPTURE_OK) {
        drop_slots(s);
        return status;
    }
    const int result = run(s);
    if (result < 0) {
        halt(s);
        drop_slots(s);
        return fail_with(camera, "start", result);
    }
    return CAPTURE_OK;
}

capture_status stop(capture *camera)
{
    state *const s = state_of(camera);

    halt(s);
    drop_slots(s);
    s->orphans.clear();
    s->first_token = s->next_token;
    return CAPTURE_OK;
}

/* ---- Healing ------------------------------------------------------------------------------- */

static capture_status restart(capture *camera)
{
    state *const s = state_of(camera);

    halt(s);
    if (is_stranded(s) || is_gone(s)) {
        s->unplugged();
        return CAPTURE_OK;
    }
    s->carry_on = true;
    camera->counts.restarts++;
    const int result = run(s);
    if (result == -ENODEV) {
        s->unplugged();
        return CAPTURE_OK;
    }
    return result < 0 ? fail_with(camera, "restart", result) : CAPTURE_OK;
}

/* What the caller holds stays readable until it is given back. */
static void keep_held_frames(state *s)
{
    for (slot &each : s->slots) {
        if (each.where == place::held) {
            s->orphans.emplace(each.token, std::move(each.maps));
        }
    }
}

static void leave(state *s)
{
    keep_held_frames(s);
    release_camera(s);
    s->away = true;
    s->away_since = clock::now();
}

/* Takes a camera that returned under its old name: 0, or a negative errno. */
static int come_back(capture *camera)
{
    state *const s = state_of(camera);

    s->camera = s->manager->get(s->id);
    if (!s->camera || is_stranded(s)) {
        s->camera.reset();
        return -ENODEV;
    }
    const int result = s->camera->acquire();
    if (result < 0) {
        s->camera.reset();
        return result;
    }
    s->acquired = true;
    {
        const std::lock_guard<std::mutex> guard(s->lock);
        s->gone = false;
    }
    s->camera->disconnected.connect(s, &state::unplugged);
    s->camera->requestCompleted.connect(s, &state::completed);
    s->nodes = nodes_of(s->manager, s->camera);
    s->carry_on = true;
    if (configure_again(camera) == CAPTURE_OK && make_slots(camera) == CAPTURE_OK && run(s) == 0) {
        return 0;
    }
    release_camera(s);
    return -EIO;
}

/* An unplugged camera: waits for it until the deadline or until patience ends. */
static capture_status wait_for_return(capture *camera, clock::time_point deadline)
{
    state *const s = state_of(camera);
    const auto patience = std::chrono::milliseconds(camera->wish.return_ms);

    if (!s->away) {
        leave(s);
    }
    while (camera->wish.return_ms > 0 && clock::now() < s->away_since + patience) {
        if (come_back(camera) == 0) {
            s->away = false;
            camera->error[0] = '\0';
            camera->counts.reopens++;
            return CAPTURE_OK;
        }
        if (clock::now() >= deadline) {
            return CAPTURE_TIMEOUT;
        }
        std::unique_lock<std::mutex> guard(s->lock);
        s->wake.wait_until(guard, std::min(deadline, clock::now() + look_again),
                           [] { return false; });
    }
    s->lost = true;
    return capture_fail(camera, CAPTURE_ERR_GONE, "%s: unplugged", s->id.c_str());
}

/* ---- Frames -------------------------------------------------------------------------------- */

/* Counts what is missing since the frame before; restarts go on counting where they stopped. */
static void note_sequence(capture *camera, uint32_t now)
{
    state *const s = state_of(camera);
    uint32_t step = now - s->last_sequence;

    if (!s->sequence_known) {
        s->sequence = s->carry_on ? s->sequence + 1 : now;
        s->sequence_known = true;
        s->last_sequence = now;
        return;
    }
    if (step == 0 || step > UINT32_MAX / 2) { /* a camera that counts wrongly lost no frame */
        step = 1;
    }
    s->sequence += step;
    s->last_sequence = now;
    s->missed += step - 1;
    camera->counts.missed += step - 1;
}

static bool is_short(const state *s, const libcamera::FrameMetadata &metadata)
{
    const auto planes = metadata.planes();

    for (unsigned i = 0; i < s->planes.planes; i++) {
        const plane_layout &plane = s->planes.plane[i];

        if (plane.buffer_plane >= planes.size() ||
            planes[plane.buffer_plane].bytesused < plane.offset_bytes + plane.needed_bytes) {
            return true;
        }
    }
    return false;
}

/* Looks at a request that came back: 1 a good frame, 0 one that the stream's end cancelled, or one
 * that was dropped and counted. */
static bool accept(capture *camera, slot *arrived)
{
    state *const s = state_of(camera);
    const libcamera::FrameMetadata &metadata = arrived->buffer->metadata();

    arrived->where = place::idle;
    if (arrived->request->status() != libcamera::Request::RequestComplete) {
        return false;
    }
    note_metadata(s, arrived->request->metadata(), arrived->number);
    s->timeouts_in_row = 0;
    note_sequence(camera, metadata.sequence);
    if (metadata.status != libcamera::FrameMetadata::FrameSuccess) {
        camera->counts.damaged++;
        return false;
    }
    if (is_short(s, metadata)) {
        camera->counts.short_frames++;
        return false;
    }
    return true;
}

static size_t all_bytes(const slot &used)
{
    const auto planes = used.buffer->metadata().planes();
    size_t bytes = planes.size() > 0 ? planes[0].bytesused : 0;

    /* Planes in memory of their own are not "all" of one piece: the view has them. */
    if (used.maps.size() == 1 && planes.size() > 1) {
        const auto &where = used.buffer->planes();
        const size_t last = planes.size() - 1;

        bytes = offset_of(where[last]) - offset_of(where[0]) + planes[last].bytesused;
    }
    return bytes;
}

static void deliver(capture *camera, slot *used, capture_frame *frame)
{
    state *const s = state_of(camera);
    const capture_settings &settings = camera->settings;
    const libcamera::FrameMetadata &metadata = used->buffer->metadata();

    announce(camera, *used, true);
    frame->view.width = static_cast<uint16_t>(settings.width);
    frame->view.height = static_cast<uint16_t>(settings.height);
    frame->view.format = settings.format;
    frame->view.range = settings.range;
    for (unsigned i = 0; i < s->planes.planes && !settings.compressed; i++) {
        frame->view.plane[i] = used->plane[i];
        frame->view.stride_bytes[i] = s->planes.plane[i].stride_bytes;
    }
    frame->bytes = used->plane[0];
    frame->byte_count = all_bytes(*used);
    frame->sequence = s->sequence;
    s->last_timestamp_us = std::max(s->last_timestamp_us, metadata.timestamp / 1000);
    frame->timestamp_us = s->last_timestamp_us;
    frame->missed = s->missed;
    s->missed = 0;
    used->token = s->next_token++;
    if (s->next_token == 0) { /* 0 is no frame */
        s->next_token = 1;
        s->first_token = 1;
    }
    used->where = place::held;
    frame->slot = used->token;
    camera->counts.frames++;
}

static capture_status fail_queue(capture *camera, int result)
{
    state *const s = state_of(camera);

    if (result == -ENODEV || is_gone(s)) {
        s->unplugged(); /* capture_next finds out what becomes of it */
        return CAPTURE_OK;
    }
    return fail_with(camera, "queueing a request", result);
}

/* Takes arrived requests in their order until one is good (newest: all of them, and keeps the
 * last good one); the others go back to the camera. */
static capture_status take_arrived(capture *camera, slot **taken)
{
    state *const s = state_of(camera);
    const bool newest = camera->wish.newest != 0;
    int result = 0;

    *taken = nullptr;
    while (result >= 0 && (newest || !*taken)) {
        slot *arrived;
        slot *unused;
        {
            const std::lock_guard<std::mutex> guard(s->lock);

            if (s->finished.empty()) {
                break;
            }
            arrived = &s->slots[s->finished.front()];
            s->finished.pop_front();
        }
        if (accept(camera, arrived)) {
            unused = *taken;
            *taken = arrived;
            camera->counts.stale += unused != nullptr;
        } else {
            unused = arrived;
        }
        if (unused) {
            result = queue(s, unused);
        }
    }
    return result < 0 ? fail_queue(camera, result) : CAPTURE_OK;
}

static bool wait_for_arrival(state *s, clock::time_point deadline)
{
    std::unique_lock<std::mutex> guard(s->lock);

    return s->wake.wait_until(guard, deadline, [s] { return s->gone || !s->finished.empty(); });
}

static capture_status time_out(capture *camera, unsigned deadline_ms)
{
    state *const s = state_of(camera);
    capture_status status = CAPTURE_OK;

    if (deadline_ms == 0) {
        return CAPTURE_TIMEOUT;
    }
    camera->counts.timeouts++;
    if (++s->timeouts_in_row >= camera->wish.restart_after) {
        s->timeouts_in_row = 0;
        status = restart(camera);
    }
    return status == CAPTURE_OK ? CAPTURE_TIMEOUT : status;
}

static bool all_held(const state *s)
{
    return std::all_of(s->slots.begin(), s->slots.end(),
                       [](const slot &each) { return each.where == place::held; });
}

capture_status next(capture *camera, unsigned deadline_ms, capture_frame *frame)
{
    state *const s = state_of(camera);
    const clock::time_point deadline = clock::now() + std::chrono::milliseconds(deadline_ms);

    for (;;) {
        slot *taken = nullptr;
        capture_status status = CAPTURE_OK;

        if (s->lost || s->away || is_gone(s)) {
            status = s->lost
                         ? capture_fail(camera, CAPTURE_ERR_GONE, "%s: unplugged", s->id.c_str())
                         : wait_for_return(camera, deadline);
        }
        if (status == CAPTURE_OK) {
            status = take_arrived(camera, &taken);
        }
        if (taken) {
            deliver(camera, taken, frame);
            return CAPTURE_OK;
        }
        if (status != CAPTURE_OK) {
            return status;
        }
        if (all_held(s)) {
            return capture_fail(camera, CAPTURE_ERR_ORDER, "all %u buffers are held",
                                static_cast<unsigned>(s->slots.size()));
        }
        if (!wait_for_arrival(s, deadline)) {
            return time_out(camera, deadline_ms);
        }
    }
}

capture_status give_back(capture *camera, const capture_frame *frame)
{
    state *const s = state_of(camera);
    const auto held = std::find_if(s->slots.begin(), s->slots.end(), [&](const slot &each) {
        return each.where == place::held && each.token == frame->slot;
    });

    if (held != s->slots.end()) {
        announce(camera, *held, false);
        held->where = place::idle;
        if (!s->running || is_gone(s)) {
            return CAPTURE_OK;
        }
        const int result = queue(s, &*held);
        return result < 0 ? fail_queue(camera, result) : CAPTURE_OK;
    }
    if (s->orphans.erase(frame->slot) > 0 || frame->slot < s->first_token) {
        return CAPTURE_OK;
    }
    return capture_fail(camera, CAPTURE_ERR_ARG, "not a frame that is out");
}

} // namespace capture_libcamera
