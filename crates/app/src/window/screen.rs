//! The window's surface: what frames are presented on.

use std::sync::Arc;

use render::{Gpu, GpuError};
use wgpu::CurrentSurfaceTexture;
use winit::event_loop::ActiveEventLoop;
use winit::window::Window;

use crate::failure::Failure;

/// A surface with its device.
pub struct Screen {
    instance: wgpu::Instance,
    window: Arc<Window>,
    surface: wgpu::Surface<'static>,
    config: wgpu::SurfaceConfiguration,
    gpu: Gpu,
}

impl Screen {
    /// Opens the adapter that can present to a window.
    ///
    /// # Errors
    /// None can; the sentence names the cure.
    pub fn new(event_loop: &ActiveEventLoop, window: Arc<Window>) -> Result<Screen, Failure> {
        let handle = Box::new(event_loop.owned_display_handle());
        let instance =
            wgpu::Instance::new(wgpu::InstanceDescriptor::new_with_display_handle_from_env(handle));
        let surface = instance.create_surface(window.clone()).map_err(|e| no_surface(&e))?;
        let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            compatible_surface: Some(&surface),
            force_fallback_adapter: false,
            apply_limit_buckets: false,
        }))
        .map_err(|e| Failure::NoScreen(GpuError::NoAdapter(e).to_string()))?;
        let gpu = Gpu::of_adapter(&adapter).map_err(|e| Failure::NoScreen(e.to_string()))?;
        let size = window.inner_size();
        let (width, height) = (size.width.max(1), size.height.max(1));
        let mut config = surface
            .get_default_config(&adapter, width, height)
            .ok_or_else(|| no_surface(&"the adapter can't present to it"))?;
        let formats = surface.get_capabilities(&adapter).formats;
        config.format = egui_wgpu::preferred_framebuffer_format(&formats).map_err(|e| no_surface(&e))?;
        config.present_mode = wgpu::PresentMode::AutoVsync;
        config.desired_maximum_frame_latency = 1;
        surface.configure(&gpu.device, &config);
        Ok(Screen { instance, window, surface, config, gpu })
    }

    /// The device.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// The format of frames.
    pub fn format(&self) -> wgpu::TextureFormat {
        self.config.format
    }

    /// Pixels.
    pub fn size(&self) -> [u32; 2] {
        [self.config.width, self.config.height]
    }

    /// Takes on a new size; a window without pixels keeps the former one.
    pub fn resize(&mut self, width: u32, height: u32) {
        if width > 0 && height > 0 {
            (self.config.width, self.config.height) = (width, height);
            self.surface.configure(&self.gpu.device, &self.config);
        }
    }

    /// The next frame to paint; `None` if this one must be left out. Asks for another where that helps.
    pub fn acquire(&mut self) -> Option<wgpu::SurfaceTexture> {
        match self.surface.get_current_texture() {
            CurrentSurfaceTexture::Success(frame) => return Some(frame),
            CurrentSurfaceTexture::Suboptimal(frame) => {
                // Configuring panics while a frame lives.
                drop(frame);
                self.surface.configure(&self.gpu.device, &self.config);
            }
            CurrentSurfaceTexture::Outdated => self.surface.configure(&self.gpu.device, &self.config),
            CurrentSurfaceTexture::Lost => match self.instance.create_surface(self.window.clone()) {
                Ok(surface) => {
                    self.surface = surface;
                    self.surface.configure(&self.gpu.device, &self.config);
                }
                Err(error) => log::error!("the window's surface is lost: {error}"),
            },
            CurrentSurfaceTexture::Timeout
            | CurrentSurfaceTexture::Occluded
            | CurrentSurfaceTexture::Validation => return None,
        }
        self.window.request_redraw();
        None
    }
}

fn no_surface(error: &dyn std::fmt::Display) -> Failure {
    Failure::NoScreen(format!(
        "no graphics adapter draws to the window ({error}): install a Vulkan driver \
         (on Debian or Ubuntu: apt install mesa-vulkan-drivers)"
    ))
}
