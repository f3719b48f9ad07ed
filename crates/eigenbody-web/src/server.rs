//! The socket: who may connect, how long anything may take, and how it all ends.

use crate::api;
use crate::explorer::{Explorer, Opening};
use hyper::server::conn::http1;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use std::io;
use std::net::{Ipv4Addr, SocketAddr, TcpListener};
use std::sync::Arc;
use std::time::Duration;
use tokio::net::TcpStream;
use tokio::sync::{Semaphore, watch};
use tokio::time::{sleep, timeout};

/// Connections at once; more wait until one ends.
const CONNECTIONS: usize = 256;
/// For the head of a request to arrive, and for an idle connection.
const HEAD: Duration = Duration::from_secs(5);
/// Bytes of a head.
const HEAD_BYTES: usize = 64 * 1024;
/// After which a connection is asked to end, and after which it is cut.
const CONNECTION: [Duration; 2] = [Duration::from_secs(300), Duration::from_secs(600)];
/// For answers on their way when the server stops.
const FAREWELL: Duration = Duration::from_secs(2);

/// An explorer that listens on the loopback interface.
pub struct Server {
    listener: TcpListener,
    address: SocketAddr,
    explorer: Arc<Explorer>,
    stop: watch::Sender<bool>,
}

/// Ends a running server, from any thread.
#[derive(Debug, Clone)]
pub struct Stopper(watch::Sender<bool>);

impl Stopper {
    /// No more connections; answers on their way have two seconds.
    pub fn stop(&self) {
        self.0.send_replace(true);
    }
}

impl Server {
    /// Takes a port of 127.0.0.1; port 0 is any free one.
    ///
    /// Errors: those of the system, such as a port that is taken.
    pub fn bind(port: u16, opening: Opening) -> io::Result<Self> {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port))?;
        let address = listener.local_addr()?;
        let explorer = Arc::new(Explorer::new(opening, address.port())?);
        Ok(Self { listener, address, explorer, stop: watch::Sender::new(false) })
    }

    /// Where the page is.
    pub fn url(&self) -> String {
        format!("http://{}/", self.address)
    }

    /// The address that it listens on.
    pub fn address(&self) -> SocketAddr {
        self.address
    }

    /// What ends it.
    pub fn stopper(&self) -> Stopper {
        Stopper(self.stop.clone())
    }

    /// Serves until it is stopped.
    ///
    /// Errors: those of the system, if threads or the socket cannot be had.
    pub fn run(self) -> io::Result<()> {
        let Self { listener, explorer, stop, .. } = self;
        listener.set_nonblocking(true)?;
        let runtime = tokio::runtime::Builder::new_multi_thread()
            .worker_threads(2)
            .max_blocking_threads(explorer.workers.threads())
            .enable_all()
            .build()?;
        let served = runtime.block_on(async {
            let listener = tokio::net::TcpListener::from_std(listener)?;
            accept(listener, explorer, stop.subscribe()).await;
            io::Result::Ok(())
        });
        // A computation that still runs is not waited for.
        runtime.shutdown_background();
        served
    }
}

async fn accept(listener: tokio::net::TcpListener, explorer: Arc<Explorer>, mut stop: watch::Receiver<bool>) {
    let service = TowerToHyperService::new(api::router(explorer));
    let slots = Arc::new(Semaphore::new(CONNECTIONS));
    loop {
        let next = async {
            let slot = Arc::clone(&slots).acquire_owned().await;
            (slot, listener.accept().await)
        };
        let (slot, accepted) = tokio::select! {
            _ = stop.wait_for(|stop| *stop) => break,
            next = next => next,
        };
        match accepted {
            Ok((stream, from)) if from.ip().is_loopback() => {
                let (service, stop) = (service.clone(), stop.clone());
                tokio::spawn(async move {
                    connection(stream, service, stop).await;
                    drop(slot);
                });
            }
            Ok(_) => {}
            // Too many open files, say: those that are open will end.
            Err(_) => sleep(Duration::from_millis(50)).await,
        }
    }
    drop(listener);
    let _ = timeout(FAREWELL, slots.acquire_many(CONNECTIONS as u32)).await;
}

async fn connection(
    stream: TcpStream,
    service: TowerToHyperService<axum::Router>,
    mut stop: watch::Receiver<bool>,
) {
    let _ = stream.set_nodelay(true);
    let mut http = http1::Builder::new();
    http.timer(TokioTimer::new()).header_read_timeout(HEAD).max_buf_size(HEAD_BYTES);
    let connection = http.serve_connection(TokioIo::new(stream), service);
    let mut connection = std::pin::pin!(connection);
    let ends = async {
        tokio::select! {
            _ = stop.wait_for(|stop| *stop) => {}
            () = sleep(CONNECTION[0]) => {}
        }
    };
    // What goes wrong on a connection is the business of who is at its other end.
    tokio::select! {
        _ = connection.as_mut() => return,
        () = ends => connection.as_mut().graceful_shutdown(),
    }
    let _ = timeout(CONNECTION[1] - CONNECTION[0], connection).await;
}
