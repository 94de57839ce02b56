//! The event loop: it waits, passes events on, and draws a frame when something asks for one.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

use egui::{Context, ViewportCommand, ViewportId};
use winit::application::ApplicationHandler;
use winit::dpi::LogicalSize;
use winit::event::{StartCause, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow};
use winit::window::{Window, WindowId};

use super::desk::Desk;
use super::screen::Screen;
use super::{display, ui_map};
use crate::failure::Failure;
use crate::painter::Painter;
use crate::theme;

/// A frame is wanted at that time.
struct Wake(Instant);

/// Runs a desk's session in a window until it is closed.
pub fn run(desk: Desk, ui_map: Option<PathBuf>) -> Result<(), Failure> {
    let event_loop = display::event_loop::<Wake>()?;
    event_loop.set_control_flow(ControlFlow::Wait);
    let ctx = Context::default();
    theme::apply(&ctx);
    if ui_map.is_some() {
        ctx.enable_accesskit();
    }
    let proxy = event_loop.create_proxy();
    ctx.set_request_repaint_callback(move |info| {
        // The loop has ended if this fails, and nobody waits for a frame.
        let _ = proxy.send_event(Wake(Instant::now() + info.delay));
    });
    let mut frames =
        Frames { desk, ctx, ui_map, shown: None, failure: None, wake: None, title: String::new(), count: 0 };
    event_loop.run_app(&mut frames).map_err(|e| Failure::NoScreen(format!("the window failed: {e}")))?;
    frames.desk.end();
    frames.failure.map_or(Ok(()), Err)
}

struct Frames {
    desk: Desk,
    ctx: Context,
    ui_map: Option<PathBuf>,
    shown: Option<Shown>,
    failure: Option<Failure>,
    wake: Option<Instant>,
    title: String,
    count: u64,
}

/// What there is while the window is open.
struct Shown {
    window: Arc<Window>,
    input: egui_winit::State,
    screen: Screen,
    painter: Painter,
}

impl Shown {
    fn open(event_loop: &ActiveEventLoop, ctx: &Context, desk: &Desk) -> Result<Shown, Failure> {
        let attributes = Window::default_attributes()
            .with_title(desk.title())
            .with_inner_size(LogicalSize::new(1280.0, 800.0))
            .with_min_inner_size(LogicalSize::new(960.0, 560.0))
            .with_visible(false);
        let window = event_loop
            .create_window(attributes)
            .map_err(|e| Failure::NoScreen(format!("the display opens no window: {e}")))?;
        let window = Arc::new(window);
        let screen = Screen::new(event_loop, window.clone())?;
        let painter = Painter::new(screen.gpu(), screen.format(), &desk.body())
            .map_err(|e| Failure::Input(e.to_string()))?;
        let input = egui_winit::State::new(
            ctx.clone(),
            ViewportId::ROOT,
            event_loop,
            Some(window.scale_factor() as f32),
            window.theme(),
            Some(screen.gpu().max_edge() as usize),
        );
        window.set_visible(true);
        window.request_redraw();
        Ok(Shown { window, input, screen, painter })
    }
}

impl Frames {
    fn draw(&mut self, event_loop: &ActiveEventLoop) {
        let Some(shown) = &mut self.shown else { return };
        let (begin, pictures) = (Instant::now(), shown.painter.pictures());
        // The frame comes first: once egui has run, its output must be painted or textures are lost.
        let Some(frame) = shown.screen.acquire() else { return };
        self.wake = None;
        let raw = shown.input.take_egui_input(&shown.window);
        let mut output = self.ctx.run_ui(raw, |ui| self.desk.ui(ui));
        let tree = output.platform_output.accesskit_update.take();
        let viewport = output.viewport_output.get(&ViewportId::ROOT);
        let delay = viewport.map(|viewport| viewport.repaint_delay);
        if viewport.is_some_and(|viewport| viewport.commands.contains(&ViewportCommand::RequestPaste)) {
            paste(&mut shown.input);
            shown.window.request_redraw();
        }
        shown.input.handle_platform_output(&shown.window, std::mem::take(&mut output.platform_output));
        let view = frame.texture.create_view(&wgpu::TextureViewDescriptor::default());
        shown.painter.paint(&self.ctx, output, shown.screen.size(), &view);
        shown.window.pre_present_notify();
        shown.painter.gpu().queue.present(frame);
        self.count += 1;
        let took = begin.elapsed();
        let quality = self.desk.drawn_in();
        log::debug!("frame {}: {:.1} ms {quality:?}", self.count, took.as_secs_f64() * 1e3);
        if shown.painter.pictures() > pictures {
            self.desk.took(self.ctx.input(|i| i.time), took.as_secs_f32());
        }
        if let (Some(path), Some(tree)) = (&self.ui_map, tree) {
            ui_map::write(path, self.count, &self.desk, &tree, self.ctx.pixels_per_point());
        }
        if let Some(at) = delay.and_then(|delay| Instant::now().checked_add(delay)) {
            self.wake_at(at);
        }
        self.after(event_loop);
    }

    fn after(&mut self, event_loop: &ActiveEventLoop) {
        if self.desk.has_quit() {
            event_loop.exit();
        }
        if let Some(shown) = self.shown.as_ref()
            && self.desk.change(shown.screen.gpu().is_software())
        {
            shown.window.request_redraw();
        }
        let title = self.desk.title();
        if let Some(shown) = self.shown.as_ref().filter(|_| title != self.title) {
            shown.window.set_title(&title);
            self.title = title;
        }
    }

    fn wake_at(&mut self, at: Instant) {
        self.wake = Some(self.wake.map_or(at, |former| former.min(at)));
    }
}

/// Hands the clipboard's text on, as the key for pasting does.
fn paste(input: &mut egui_winit::State) {
    if let Some(text) = input.clipboard_text().filter(|text| !text.is_empty()) {
        input.egui_input_mut().events.push(egui::Event::Paste(text.replace("\r\n", "\n")));
    }
}

impl ApplicationHandler<Wake> for Frames {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if self.shown.is_some() {
            return;
        }
        match Shown::open(event_loop, &self.ctx, &self.desk) {
            Ok(shown) => {
                self.desk.set_software(shown.screen.gpu().is_software());
                self.shown = Some(shown);
            }
            Err(failure) => {
                self.failure = Some(failure);
                event_loop.exit();
            }
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(shown) = &mut self.shown else { return };
        match &event {
            WindowEvent::RedrawRequested => return self.draw(event_loop),
            WindowEvent::CloseRequested => {
                self.desk.quit_asking();
                shown.window.request_redraw();
            }
            WindowEvent::Resized(size) => shown.screen.resize(size.width, size.height),
            _ => {}
        }
        if shown.input.on_window_event(&shown.window, &event).repaint {
            shown.window.request_redraw();
        }
    }

    fn user_event(&mut self, _: &ActiveEventLoop, Wake(at): Wake) {
        self.wake_at(at);
    }

    fn new_events(&mut self, _: &ActiveEventLoop, _: StartCause) {
        let due = self.wake.is_some_and(|at| at <= Instant::now());
        if let Some(shown) = self.shown.as_ref().filter(|_| due) {
            self.wake = None;
            shown.window.request_redraw();
        }
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        event_loop.set_control_flow(self.wake.map_or(ControlFlow::Wait, ControlFlow::WaitUntil));
    }
}
