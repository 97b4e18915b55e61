//! The server: connections on the loopback address, few and short ones, until the last window is closed.

use std::convert::Infallible;
use std::io;
use std::net::{Ipv4Addr, TcpListener};
use std::pin::pin;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper_util::rt::{TokioIo, TokioTimer};
use tokio::net::TcpStream;
use tokio::time::{sleep, timeout};

use super::access::Access;
use super::desk::Desk;
use super::routes::{self, Site};
use super::windows::{Absence, Windows};

/// Connections at a time; more are closed at once.
const MOST_CONNECTIONS: usize = 400;
/// Longest time until the head of a request is there, also of the next one on the same connection.
const HEAD_TIME: Duration = Duration::from_secs(5);
/// Greatest size of a head, bytes, and number of its lines.
const MOST_HEAD: (usize, usize) = (16 * 1024, 64);
/// Longest life of a connection that is no window's; a request under way is finished within the second time.
const LIFE: (Duration, Duration) = (Duration::from_secs(300), Duration::from_secs(150));
/// Time between looks for the end.
const LOOK: Duration = Duration::from_millis(100);
/// Threads that compute or wait for it.
const MOST_AT_WORK: usize = 32;

/// Listener on `port` of the loopback address, or on a free one, and its port.
pub(super) fn bind(port: u16) -> io::Result<(TcpListener, u16)> {
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port))?;
    listener.set_nonblocking(true)?;
    let port = listener.local_addr()?.port();
    Ok((listener, port))
}

/// Serves until all windows are closed, or the user interrupts.
pub(super) fn serve(listener: TcpListener, desk: Desk, access: Access, interrupted: &AtomicBool) -> io::Result<()> {
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_io()
        .enable_time()
        .max_blocking_threads(MOST_AT_WORK)
        .build()?;
    let windows = Arc::new(Windows::default());
    let site = Arc::new(Site { desk, access, windows: Arc::clone(&windows) });
    let ended = runtime.block_on(async {
        let listener = tokio::net::TcpListener::from_std(listener)?;
        let accepted = tokio::spawn(accept(listener, site));
        let mut absence = Absence::default();
        while !interrupted.load(Ordering::Relaxed) && !absence.is_long(&windows, Instant::now()) {
            sleep(LOOK).await;
        }
        accepted.abort();
        Ok(())
    });
    // Answers under way stop by themselves.
    interrupted.store(true, Ordering::Relaxed);
    runtime.shutdown_background();
    ended
}

/// Accepts connections.
async fn accept(listener: tokio::net::TcpListener, site: Arc<Site>) {
    let open = Arc::new(AtomicUsize::new(0));
    loop {
        match listener.accept().await {
            Ok((stream, _)) => {
                if open.fetch_add(1, Ordering::Relaxed) < MOST_CONNECTIONS {
                    tokio::spawn(connection(stream, Arc::clone(&site), Counted(Arc::clone(&open))));
                } else {
                    open.fetch_sub(1, Ordering::Relaxed);
                }
            }
            // Too many open files, say: some are closed soon.
            Err(_) => sleep(LOOK).await,
        }
    }
}

/// A connection that is counted as long as this exists.
struct Counted(Arc<AtomicUsize>);

impl Drop for Counted {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }
}

/// Serves a connection to its end; what goes wrong on it is no concern of others.
async fn connection(stream: TcpStream, site: Arc<Site>, _counted: Counted) {
    // Answers are small, and go at once.
    let _ = stream.set_nodelay(true);
    let is_window = Arc::new(AtomicBool::new(false));
    let seen = Arc::clone(&is_window);
    let service = service_fn(move |request: hyper::Request<hyper::body::Incoming>| {
        let (site, seen) = (Arc::clone(&site), Arc::clone(&seen));
        async move {
            let is_stream = request.uri().path().ends_with("/window");
            let answered = routes::answer(site, request).await;
            seen.store(is_stream && answered.status().is_success(), Ordering::Relaxed);
            Ok::<_, Infallible>(answered)
        }
    });
    let mut http = http1::Builder::new();
    http.timer(TokioTimer::new()).header_read_timeout(HEAD_TIME).max_buf_size(MOST_HEAD.0).max_headers(MOST_HEAD.1);
    let mut served = pin!(http.serve_connection(TokioIo::new(stream), service));
    while timeout(LIFE.0, served.as_mut()).await.is_err() {
        if !is_window.load(Ordering::Relaxed) {
            served.as_mut().graceful_shutdown();
            let _ = timeout(LIFE.1, served).await;
            return;
        }
    }
}
