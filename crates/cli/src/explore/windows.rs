//! Windows that show the page: each holds a stream open, and the server ends some seconds after the last is closed.

use std::pin::Pin;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::task::{Context, Poll};
use std::time::{Duration, Instant};

use hyper::body::{Body, Bytes, Frame};
use tokio::time::{Interval, interval};

/// Time between two signs of life, after which a closed window is noticed.
const BEAT: Duration = Duration::from_secs(1);
/// Time that a page may take to be loaded again.
const GRACE: Duration = Duration::from_secs(4);

/// Number of windows.
#[derive(Debug, Default)]
pub(super) struct Windows {
    open: AtomicUsize,
    /// Whether there has been one.
    any: AtomicBool,
}

impl Windows {
    /// Stream of a window; it is open as long as this exists.
    pub(super) fn stream(self: &Arc<Self>) -> OpenWindow {
        self.open.fetch_add(1, Ordering::Relaxed);
        self.any.store(true, Ordering::Relaxed);
        OpenWindow { windows: Arc::clone(self), beat: interval(BEAT) }
    }

    /// Whether there was a window and is none.
    fn are_closed(&self) -> bool {
        self.any.load(Ordering::Relaxed) && self.open.load(Ordering::Relaxed) == 0
    }
}

/// How long all windows have been closed.
#[derive(Debug, Default)]
pub(super) struct Absence {
    since: Option<Instant>,
}

impl Absence {
    /// Whether all windows have been closed for the time of grace; to be asked again and again.
    pub(super) fn is_long(&mut self, windows: &Windows, now: Instant) -> bool {
        if !windows.are_closed() {
            self.since = None;
            return false;
        }
        now.duration_since(*self.since.get_or_insert(now)) >= GRACE
    }
}

/// Body of an event stream that says nothing but that the server is there.
pub(super) struct OpenWindow {
    windows: Arc<Windows>,
    beat: Interval,
}

impl Drop for OpenWindow {
    fn drop(&mut self) {
        self.windows.open.fetch_sub(1, Ordering::Relaxed);
    }
}

impl Body for OpenWindow {
    type Data = Bytes;
    type Error = std::convert::Infallible;

    fn poll_frame(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, Self::Error>>> {
        self.beat.poll_tick(context).map(|_| Some(Ok(Frame::data(Bytes::from_static(b":\n\n")))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_server_ends_some_time_after_the_last_window() {
        let runtime = tokio::runtime::Builder::new_current_thread().enable_time().build().unwrap();
        let _within = runtime.enter();
        let (windows, mut absence, start) = (Arc::new(Windows::default()), Absence::default(), Instant::now());
        assert!(!absence.is_long(&windows, start + 10 * GRACE), "no window has been opened yet");
        let window = windows.stream();
        assert!(!absence.is_long(&windows, start));
        drop(window);
        assert!(!absence.is_long(&windows, start));
        let again = windows.stream();
        assert!(!absence.is_long(&windows, start + 2 * GRACE), "loaded again");
        drop(again);
        assert!(!absence.is_long(&windows, start + 3 * GRACE));
        assert!(absence.is_long(&windows, start + 4 * GRACE));
    }
}
